// Effects as values: what makes two the same, and how they fade beyond the ranges they were measured in.
#include "effects/effect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "laden_arm.hpp"

namespace demecal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Effect ranged(double lower, double upper, int joint = 1) {
  return {.kind = "gain", .joint = 1, .ranges = {{joint, {lower, upper}}}};
}

double share_at(const Effect& effect, double value, int joint = 1) {
  RandomStream stream{32, 0};
  static const Chain chain = laden_arm(stream, Arm::sliding_standard).chain;
  JointVector q = JointVector::Zero(6);
  q[joint] = value;
  return known_share(effect, chain, q);
}

TEST(Effect, IsTheSameLawWhateverItsCoefficients) {
  const Effect effect{.kind = "coupling", .joint = 2, .settings = {{"from", 2}}, .form = "linear"};
  Effect other = effect;
  other.values = {0.1};
  other.standard_errors = {0.2};
  other.ranges = {{1, {0, 1}}};
  EXPECT_TRUE(effect.same_law_as(other));
  EXPECT_EQ(other.value(0), 0.1);
  EXPECT_EQ(effect.value(0), 0.0);
  Effect kind = effect, joint = effect, setting = effect, form = effect, formula = effect;
  kind.kind = "gain";
  joint.joint = 3;
  setting.settings["from"] = 1;
  form.form = "harmonic";
  formula.formula = constant_tree(1.0);
  for (const Effect& different : {kind, joint, setting, form, formula}) EXPECT_FALSE(effect.same_law_as(different));
}

TEST(Effect, WithoutFormIsOfItsLawsFirst) {
  const Effect plain{.kind = "backlash", .joint = 2};
  const Effect named{.kind = "backlash", .joint = 2, .settings = {}, .form = "approach"};
  const Effect seated{.kind = "backlash", .joint = 2, .settings = {}, .form = "seated"};
  EXPECT_TRUE(plain.same_law_as(named));
  EXPECT_FALSE(plain.same_law_as(seated));
}

TEST(KnownShare, IsOneWithoutRangesAndWithinThem) {
  EXPECT_EQ(share_at({.kind = "gain", .joint = 1}, 100.0), 1.0);
  const Effect effect = ranged(-0.5, 1.0);
  for (const double inside : {-0.5, 0.0, 1.0}) EXPECT_EQ(share_at(effect, inside), 1.0);
}

TEST(KnownShare, FadesSmoothlyWithinATenthBeyond) {
  const Effect effect = ranged(-0.5, 1.0);
  EXPECT_NEAR(share_at(effect, 1.05), 0.5, 1e-12);
  EXPECT_NEAR(share_at(effect, -0.55), 0.5, 1e-12);
  EXPECT_EQ(share_at(effect, 1.1001), 0.0);
  EXPECT_EQ(share_at(effect, -2.0), 0.0);
  double last = 1.0;
  for (double beyond = 0.001; beyond < 0.1; beyond += 0.001) {
    const double share = share_at(effect, 1.0 + beyond);
    EXPECT_LT(share, last);
    EXPECT_GT(share, last - 0.0151);  // the steepest slope of the step is 1.5 over its width
    last = share;
  }
  EXPECT_GT(share_at(effect, 1.001), 0.9996);
}

TEST(KnownShare, IgnoresWholeTurnsOfRevoluteJointsOnly) {
  EXPECT_EQ(share_at(ranged(3.0, 3.5), 3.2 - kTurn), 1.0);
  EXPECT_EQ(share_at(ranged(-0.5, 1.0), 0.2 + 2 * kTurn), 1.0);
  EXPECT_EQ(share_at(ranged(-0.5, 0.5, 2), 0.2 + kTurn, 2), 0.0) << "joint 3 slides";
}

TEST(MeasuredRange, ARippleFadesBeyondItFromWhatItIsAtTheEnd) {
  RandomStream stream{32, 1};
  const Robot robot = laden_arm(stream, Arm::standard);
  Stop stop = random_stop(stream, robot);
  const Effect everywhere{.kind = "gear_harmonic", .joint = 1, .settings = {{"ratio", 24}}};
  Effect ranged = everywhere;
  ranged.ranges = {{1, {0.0, 1.0}}};
  stop.joints[1] = 1.0;
  std::vector<UnitMotion> at_end{{7, 0, 0, 1.0}}, faded = at_end, none = at_end;
  append_unit_motions(everywhere, robot, arm_state(robot, stop), at_end);
  stop.joints[1] = 1.04;
  append_unit_motions(ranged, robot, arm_state(robot, stop), faded);
  ASSERT_EQ(faded.size(), at_end.size());
  const double share = known_share(ranged, robot.chain, stop.joints);
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 0.8);
  EXPECT_EQ(faded[0].size, 1.0) << "what stood there before";
  for (std::size_t i = 1; i < at_end.size(); ++i) EXPECT_EQ(faded[i].size, share * at_end[i].size);
  stop.joints[1] = 1.5;
  append_unit_motions(ranged, robot, arm_state(robot, stop), none);
  EXPECT_EQ(none.size(), 1u);
}

/// A slow effect of joint 2, measured from 0 to 1 rad, with the joint at `angle_rad`; or as if measured everywhere.
std::vector<UnitMotion> wobble_at(double angle_rad, bool everywhere = false, Arm arm = Arm::standard) {
  RandomStream stream{32, 2};
  const Robot robot = laden_arm(stream, arm);
  Stop stop = random_stop(stream, robot);
  Effect effect{.kind = "axis_wobble", .joint = 1, .settings = {{"order", 1}}};
  if (!everywhere) effect.ranges = {{1, {0.0, 1.0}}};
  stop.joints[1] = angle_rad;
  std::vector<UnitMotion> motions;
  append_unit_motions(effect, robot, arm_state(robot, stop), motions);
  return motions;
}

/// Of every coefficient, what all its motions come to.
std::map<int, double> sizes(const std::vector<UnitMotion>& motions) {
  std::map<int, double> sums;
  for (const UnitMotion& motion : motions) sums[motion.coefficient] += motion.size;
  return sums;
}

TEST(MeasuredRange, ASlowEffectGoesOnFromWhatItIsAtTheEnd) {
  const auto at_end = sizes(wobble_at(1.0, true)), beyond = sizes(wobble_at(1.1)), before = sizes(wobble_at(-0.1));
  const auto at_begin = sizes(wobble_at(0.0, true));
  ASSERT_EQ(beyond.size(), at_end.size());
  for (const auto& [coefficient, size] : at_end) {
    EXPECT_NEAR(beyond.at(coefficient), size, 2e-3);
    EXPECT_NEAR(before.at(coefficient), at_begin.at(coefficient), 2e-3);
  }
}

TEST(MeasuredRange, OfATurnAndMoreAnEffectStaysWhatItIsAtTheNearerEnd) {
  RandomStream stream{32, 3};
  const Robot robot = laden_arm(stream, Arm::standard);
  const Stop anywhere = random_stop(stream, robot);
  const auto size_at = [&](const Effect& effect, double angle_rad) {
    Stop stop = anywhere;
    stop.joints[1] = angle_rad;
    std::vector<UnitMotion> motions;
    append_unit_motions(effect, robot, arm_state(robot, stop), motions);
    return sizes(motions).at(0);
  };
  const Effect everywhere{.kind = "gain", .joint = 1};
  Effect ranged = everywhere;
  ranged.ranges = {{1, {-5.1, 5.0}}};
  for (const double inside : {-5.1, -1.0, 4.9, 5.0}) EXPECT_EQ(size_at(ranged, inside), size_at(everywhere, inside));
  for (const double beyond : {5.0001, 5.3, 8.0}) EXPECT_EQ(size_at(ranged, beyond), size_at(everywhere, 5.0));
  for (const double beyond : {-5.1001, -6.0}) EXPECT_EQ(size_at(ranged, beyond), size_at(everywhere, -5.1));
}

TEST(MeasuredRange, ASlowEffectGoesOverToItsOtherEndAcrossTheUnmeasuredTurnWithoutAJump) {
  const auto lower = sizes(wobble_at(0.0, true)), upper = sizes(wobble_at(1.0, true));
  const double opposite = 0.5 + std::numbers::pi;
  for (const double angle_rad : {opposite - 1e-9, opposite + 1e-9, opposite - kTurn}) {
    for (const auto& [coefficient, size] : sizes(wobble_at(angle_rad)))
      EXPECT_NEAR(size, 0.5 * (lower.at(coefficient) + upper.at(coefficient)), 1e-8) << angle_rad;
  }
  constexpr int kSteps = 400;
  std::map<int, double> last = sizes(wobble_at(0.0));
  for (int i = 1; i <= kSteps; ++i) {
    const auto now = sizes(wobble_at(kTurn * i / kSteps));
    for (const auto& [coefficient, size] : now) EXPECT_NEAR(size, last.at(coefficient), 0.03) << i;
    last = now;
  }
}

std::set<double> ratios_tried(const Robot& robot, int joint) {
  Evidence evidence;
  evidence.highest_ratio = 20;
  std::set<double> ratios;
  for (const Effect& effect : find_law("gear_harmonic")->proposals(robot, evidence))
    if (effect.joint == joint) ratios.insert(effect.setting("ratio"));
  return ratios;
}

TEST(GearHarmonics, AreTriedAtTheLinesOfAStatedGearAndNamedByIt) {
  RandomStream stream{33, 0};
  Robot robot = laden_arm(stream, Arm::sliding_standard);
  int joint = 0;
  while (!is_revolute(robot.chain, joint)) ++joint;
  std::optional<Gear>& gear = robot.chain.joints[static_cast<std::size_t>(joint)].gear;
  const std::set<double> plain = ratios_tried(robot, joint);
  EXPECT_EQ(*plain.rbegin(), 20.0);
  gear = Gear{GearKind::strain_wave, 80.5};
  std::set<double> with_gear = ratios_tried(robot, joint);
  for (const double line : {80.5, 161.0, 241.5, 322.0}) EXPECT_EQ(with_gear.erase(line), 1U) << line;
  EXPECT_EQ(with_gear, plain);
  const auto said = [&](double ratio) {
    return find_law("gear_harmonic")
        ->diagnosis({.kind = "gear_harmonic", .joint = joint, .settings = {{"ratio", ratio}}, .values = {1e-4, 0.0}},
                    robot);
  };
  EXPECT_NE(said(161.0).find("a strain wave gear, twice an input turn."), std::string::npos) << said(161.0);
  EXPECT_NE(said(100.0).find("of whose ratio, 80.5, it is no multiple"), std::string::npos) << said(100.0);
  gear = Gear{GearKind::cycloidal, 59.0};
  EXPECT_TRUE(ratios_tried(robot, joint).contains(60.0));
  EXPECT_NE(said(60.0).find("as its pins pass"), std::string::npos) << said(60.0);
  gear.reset();
  EXPECT_NE(said(60.0).find("a gear stage."), std::string::npos) << said(60.0);
}

TEST(UnitMotions, OfAJumpGoHalfItsHeightToEitherSide) {
  RandomStream stream{31, 40};
  const Robot robot = laden_arm(stream, Arm::standard);
  const auto size_at = [&](const Effect& effect, double q2_rad) {
    Stop stop = random_stop(stream, robot);
    stop.joints[1] = q2_rad;
    std::vector<UnitMotion> motions;
    law_of(effect).unit_motions(effect, robot, arm_state(robot, stop), motions);
    return motions.empty() ? 0.0 : motions.at(0).size;
  };
  const Effect step{.kind = "jump", .joint = 1, .settings = {{"at_rad", -0.3}}};
  EXPECT_EQ(size_at(step, -0.31), -0.5);
  EXPECT_EQ(size_at(step, -0.3), 0.0);
  EXPECT_EQ(size_at(step, 2.0), 0.5);
  const Effect square{
      .kind = "jump", .joint = 1, .settings = {{"at_rad", 0.2}, {"per_turn", 4}}, .form = "square_wave"};
  const double half_rad = std::numbers::pi / 4.0;
  for (int half = -3; half <= 3; ++half)
    EXPECT_EQ(size_at(square, 0.2 + (half + 0.5) * half_rad), half % 2 == 0 ? 0.5 : -0.5) << half;
}

TEST(FinerProposals, LieBetweenThoseNextToIt) {
  RandomStream stream{31, 41};
  const Robot robot = laden_arm(stream, Arm::standard);
  const Evidence evidence = full_evidence(robot);
  const EffectLaw& law = *find_law("jump");
  const std::vector<Effect> proposals = law.proposals(robot, evidence);
  const Effect& before = proposals.at(3);
  const std::vector<Effect> finer = law.finer_proposals(before, evidence);
  const double apart = proposals.at(4).setting("at_rad") - before.setting("at_rad");
  EXPECT_NEAR(finer.front().setting("at_rad"), before.setting("at_rad") - apart, 1e-12);
  EXPECT_NEAR(finer.back().setting("at_rad"), proposals.at(4).setting("at_rad"), 1e-12);
  EXPECT_TRUE(
      std::ranges::any_of(finer, [&](const Effect& one) { return one.setting("at_rad") == before.setting("at_rad"); }));
  const double part = finer.at(1).setting("at_rad") - finer.front().setting("at_rad");
  const Effect between = law.between(finer.at(2), finer.at(6));
  EXPECT_NEAR(between.setting("at_rad"), finer.at(4).setting("at_rad"), 1e-12);
  EXPECT_NEAR(between.setting("within_rad"), 3.0 * part, 1e-12);  // the next on either side explain less
  EXPECT_TRUE(find_law("gear_harmonic")->finer_proposals({.kind = "gear_harmonic", .joint = 1}, evidence).empty());
}

}  // namespace
}  // namespace demecal
