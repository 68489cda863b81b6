// What is tried: evidence of the data, candidates within it, controls that cannot be true, formulas, rivals.
#include "diagnosis/candidates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/scan.hpp"
#include "residuals/measured_arm.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

KnownArm measured(RandomStream& stream, int poses) {
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  measure_anyhow(arm, stream, {.noise_m = 5e-5}, poses);
  return arm;
}

std::vector<std::string> kinds_of(const std::vector<UntestableKind>& unseen) {
  std::vector<std::string> kinds;
  for (const UntestableKind& each : unseen) {
    EXPECT_FALSE(each.reason.empty());
    kinds.push_back(each.kind);
  }
  return kinds;
}

TEST(Evidence, HoldsWhatWasRecordedAndVaried) {
  RandomStream stream{88, 1};
  const KnownArm arm = measured(stream, 30);
  const Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  EXPECT_TRUE(evidence.approach && evidence.payload && evidence.temperature && evidence.time && evidence.masses);
  EXPECT_FALSE(evidence.orientation);
  double temperature = 0.0, lowest = 10.0;
  for (const MeasuredPose& pose : arm.data.poses) {
    temperature += *pose.temperature_celsius / 30;
    lowest = std::min(lowest, pose.joints[4]);
  }
  EXPECT_NEAR(evidence.mean_temperature_celsius, temperature, 1e-9);
  ASSERT_EQ(evidence.joint_ranges.size(), 6u);
  EXPECT_EQ(evidence.joint_ranges[4].lower, lowest);
  EXPECT_THAT(untestable_kinds(evidence, {}), IsEmpty());
}

TEST(Evidence, LacksWhatOnePoseLacksOrWhatNeverChanged) {
  RandomStream stream{88, 2};
  KnownArm arm = measured(stream, 30);
  arm.data.robot.masses.clear();
  arm.data.poses[3].temperature_celsius.reset();
  for (std::size_t i = 0; i < 30; ++i) {
    MeasuredPose& pose = arm.data.poses[i];
    pose.payload_kg = 2.0;
    pose.time_s = 17.0;
    for (int joint = 0; joint < 6; ++joint) (*pose.approach)[joint] = joint % 2 == 0 ? 1.0 : -1.0;
  }
  const Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  EXPECT_FALSE(evidence.approach || evidence.payload || evidence.temperature || evidence.time || evidence.masses);
  EXPECT_THAT(kinds_of(untestable_kinds(evidence, {})),
              UnorderedElementsAre("backlash", "hysteresis", "thermal_offset", "thermal_length", "drift"));
  EXPECT_THAT(kinds_of(untestable_kinds(evidence, {"drift", "gain"})), UnorderedElementsAre("drift"));
}

TEST(Candidates, AreEveryLawsProposalsWithinTheEvidence) {
  RandomStream stream{88, 3};
  const KnownArm arm = measured(stream, 20);
  Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  evidence.highest_ratio = 7;
  const std::vector<Candidate> all =
      candidates_for(arm.data.robot, evidence, {}, {.kinds = {}, .formulas = false, .decoys = false});
  for (const EffectLaw* law : catalogue()) {
    std::size_t found = 0;
    const std::vector<Effect> proposals = law->proposals(arm.data.robot, evidence);
    for (const Candidate& candidate : all) {
      if (candidate.effect.kind != law->kind()) continue;
      EXPECT_EQ(candidate.decoy_kind, DecoyKind::none);
      const auto alike = std::ranges::count(proposals, candidate.effect.form, &Effect::form);
      EXPECT_NEAR(candidate.naming_cost_nats, std::log(static_cast<double>(alike)), 1e-12);
      for (const int joint : law->ranged_joints(candidate.effect, arm.data.robot)) {
        ASSERT_TRUE(candidate.effect.ranges.contains(joint));
        EXPECT_EQ(candidate.effect.ranges.at(joint), evidence.joint_ranges[static_cast<std::size_t>(joint)]);
      }
      ++found;
    }
    EXPECT_EQ(found, law->is_last_resort() ? 0 : proposals.size()) << law->kind();
  }
}

TEST(Candidates, AreNeitherDeclaredNorUnwanted) {
  RandomStream stream{88, 4};
  const KnownArm arm = measured(stream, 20);
  const Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  std::set<std::string> kinds;
  const DeclaredModel declared{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, declared, {})) kinds.insert(each.effect.kind);
  for (const char* kind : {"registration", "tool", "joint_offset", "geometry"}) EXPECT_THAT(kinds, Not(Contains(kind)));
  EXPECT_EQ(kinds.size(), catalogue().size() - 5);  // and jumps, which wait
  kinds.clear();
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, declared, {.kinds = {}, .last_resort = true}))
    kinds.insert(each.effect.kind);
  EXPECT_THAT(kinds, UnorderedElementsAre("jump"));
  kinds.clear();
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, {}, {.kinds = {"gain", "tool"}})) {
    kinds.insert(each.effect.kind);
  }
  EXPECT_THAT(kinds, UnorderedElementsAre("gain", "tool"));
}

TEST(Candidates, LeaveOutWhatDeclaredCorrectionsHoldAlready) {
  RandomStream stream{88, 9};
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::sliding_standard));
  measure_anyhow(arm, stream, {.noise_m = 5e-5}, 20);
  const Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  std::map<std::string, std::set<int>> joints;
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, {.joint_corrections = true}, {})) {
    if (each.effect.kind == "gear_harmonic" && each.effect.setting("ratio") > 3) continue;
    joints[each.effect.kind].insert(each.effect.joint);
  }
  EXPECT_THAT(joints["gain"], UnorderedElementsAre(2));  // the sliding one, which has no correction
  EXPECT_THAT(joints["joint_offset"], UnorderedElementsAre(2));
  EXPECT_THAT(joints["gear_harmonic"], IsEmpty());
  EXPECT_THAT(joints["eccentricity"], IsEmpty());
  EXPECT_EQ(joints["backlash"].size(), 6u);
}

TEST(Candidates, HaveDecoysThatCannotBeTrue) {
  RandomStream stream{88, 5};
  const KnownArm arm = measured(stream, 20);
  Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  evidence.highest_ratio = 30;
  std::map<DecoyKind, std::vector<Candidate>> by_kind;
  std::set<std::string> names;
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, {}, {.kinds = {}, .formulas = false})) {
    by_kind[each.decoy_kind].push_back(each);
    if (each.decoy_kind != DecoyKind::none) names.insert(decoy_name(each));
  }
  for (const DecoyKind decoy_kind :
       {DecoyKind::wrong_ratio, DecoyKind::shuffled_approach, DecoyKind::shuffled_temperature}) {
    std::set<int> joints;
    for (const Candidate& each : by_kind[decoy_kind]) joints.insert(each.effect.joint);
    EXPECT_EQ(joints.size(), 6u);
    EXPECT_EQ(by_kind[decoy_kind].size(), 6u);
  }
  EXPECT_EQ(names.size(), 18u);
  for (const Candidate& each : by_kind[DecoyKind::wrong_ratio]) {
    const double ratio = each.effect.setting("ratio");
    EXPECT_GT(ratio, 30.0);
    EXPECT_GT(std::abs(ratio - std::round(ratio)), 0.01);
  }
  evidence.approach = evidence.temperature = false;
  for (const Candidate& each : candidates_for(arm.data.robot, evidence, {}, {.kinds = {}, .formulas = false})) {
    EXPECT_TRUE(each.decoy_kind == DecoyKind::none || each.decoy_kind == DecoyKind::wrong_ratio);
  }
}

TEST(Candidates, DisguisesDealOneCircumstanceOutAnew) {
  RandomStream stream{88, 6};
  const KnownArm arm = measured(stream, 40);
  const std::vector<ArmState> states = field_of(arm, {}).states;
  const std::vector<ArmState> sides = with_shuffled(states, DecoyKind::shuffled_approach, RandomStream{1});
  const std::vector<ArmState> heat = with_shuffled(states, DecoyKind::shuffled_temperature, RandomStream{1});
  std::multiset<double> before, after;
  int moved = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(sides[i].stop.temperature_celsius, states[i].stop.temperature_celsius);
    EXPECT_EQ(heat[i].stop.approach, states[i].stop.approach);
    EXPECT_EQ(sides[i].stop.joints, states[i].stop.joints);
    before.insert(*states[i].stop.temperature_celsius);
    after.insert(*heat[i].stop.temperature_celsius);
    moved += heat[i].stop.temperature_celsius != states[i].stop.temperature_celsius;
    moved += sides[i].stop.approach != states[i].stop.approach;
  }
  EXPECT_EQ(before, after);
  EXPECT_GT(moved, 70);
}

TEST(FormulaLibrary, HasEachFormulaOnceOfMovingJointsAndKnownCircumstances) {
  RandomStream stream{88, 7};
  KnownArm arm = measured(stream, 20);
  for (MeasuredPose& pose : arm.data.poses) pose.joints[5] = 0.3;
  Evidence evidence = evidence_of(arm.data, all_poses(arm.data));
  const VariableNames names = symbolic_variables(arm.data.robot.chain);
  std::set<std::string> all;
  const std::vector<Effect> library = formula_library(arm.data.robot, evidence);
  for (const Effect& effect : library) {
    const std::string text = to_string(effect.formula, names);
    EXPECT_THAT(text, Not(::testing::HasSubstr("q6")));
    all.insert(std::to_string(effect.joint) + ": " + effect.form + text);
  }
  EXPECT_EQ(all.size(), library.size());
  EXPECT_THAT(all, Contains("2: " + to_string(parse("SIN(q2+2*q3)", names), names)));
  EXPECT_THAT(all, Contains("2: wave" + to_string(parse("q2+2*q3", names), names)));
  EXPECT_THAT(all, Contains("0: " + to_string(parse("s*tau", names), names)));
  evidence.approach = evidence.temperature = evidence.masses = false;
  for (const Effect& effect : formula_library(arm.data.robot, evidence)) {
    for (const Node& node : effect.formula) {
      EXPECT_LT(node.variable, 6);
    }
  }
}

TEST(Rivals, AFormulaIsNoRivalOfItselfWithAPhase) {
  RandomStream stream{88, 9};
  const KnownArm arm = measured(stream, 40);
  ResidualField field = field_of(arm, {.registration = true, .joint_offset = true});
  const VariableNames names = symbolic_variables(arm.data.robot.chain);
  const auto symbolic = [&](const char* form, const char* text) {
    Effect effect{.kind = "symbolic", .joint = 2, .form = form};
    effect.formula = parse(text, names);
    return effect;
  };
  const std::vector<Effect> effects{symbolic("", "SIN(q2-q4)"), symbolic("wave", "q2-q4"),
                                    symbolic("", "SIN(q2-q4)*1")};
  const EffectColumns columns = columns_of(effects, arm.data.robot, field);
  renew_noise(field, stream);
  field.residual += 3e-4 * columns.dense(field, 0).col(0);
  const Projection model = projection_of(field);
  const Scan scan(columns, {0, 0, 0}, field, model);
  const std::vector<Candidate> candidates{{.effect = effects[0]}, {.effect = effects[1]}, {.effect = effects[2]}};
  const Projection::Trial trial = model.trial(columns.dense(field, 0), columns.dense(field, 0));
  const std::vector<Rival> rivals =
      rivals_of(0, trial, columns.transposed_times(field, trial.columns()), candidates, scan.scores(), scan);
  ASSERT_EQ(rivals.size(), 1u);
  EXPECT_TRUE(rivals[0].effect.same_law_as(effects[2]));
  const Projection::Trial wave = model.trial(columns.dense(field, 1), columns.dense(field, 1));
  EXPECT_FALSE(
      rivals_of(1, wave, columns.transposed_times(field, wave.columns()), candidates, scan.scores(), scan).empty());
}

TEST(Rivals, AreCandidatesThatExplainTheSame) {
  RandomStream stream{88, 8};
  KnownArm arm = measured(stream, 40);
  for (MeasuredPose& pose : arm.data.poses) pose.joints[3] = 0.5 + 0.999 * pose.joints[1] + 1e-3 * stream.normal();
  ResidualField field = field_of(arm, {.registration = true, .joint_offset = true});
  std::vector<Candidate> candidates = {
      {.effect = {.kind = "coupling", .joint = 2, .settings = {{"from", 2}}, .form = "linear"}},
      {.effect = {.kind = "coupling", .joint = 2, .settings = {{"from", 4}}, .form = "linear"}},
      {.effect = {.kind = "backlash", .joint = 2, .settings = {}, .form = "approach"}},
      {.effect = {.kind = "coupling", .joint = 2, .settings = {{"from", 4}}, .form = "linear"},
       .decoy_kind = DecoyKind::shuffled_approach}};
  std::vector<Effect> effects;
  for (const Candidate& candidate : candidates) effects.push_back(candidate.effect);
  const EffectColumns columns = columns_of(effects, arm.data.robot, field);
  renew_noise(field, stream);
  field.residual += 3e-4 * columns.dense(field, 0).col(0);
  const Projection model = projection_of(field);
  const Scan scan(columns, {0, 0, 0, 0}, field, model);
  const Projection::Trial trial = model.trial(columns.dense(field, 0), columns.dense(field, 0));
  const std::vector<Rival> rivals =
      rivals_of(0, trial, columns.transposed_times(field, trial.columns()), candidates, scan.scores(), scan);
  ASSERT_EQ(rivals.size(), 1u);
  EXPECT_TRUE(rivals[0].effect.same_law_as(candidates[1].effect));
  EXPECT_GT(rivals[0].cosine, 0.99);
}

}  // namespace
}  // namespace demecal
