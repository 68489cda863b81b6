// The closed loop's benchmark: its truths are what the laws say, and its scores count what they claim to.
#include <gtest/gtest.h>

#include <set>

#include "closed_loop/draw_truth.hpp"
#include "closed_loop/scene.hpp"
#include "closed_loop/summary.hpp"
#include "closed_loop/truth.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"

namespace demecal::bench {
namespace {

Robot small_arm() {
  Robot robot;
  robot.name = "small arm";
  const double half_turn = radians(180.0);
  for (int joint = 0; joint < 6; ++joint) {
    const double alpha = joint % 2 == 0 ? radians(-90.0) : radians(80.0);
    robot.chain.joints.push_back({JointType::revolute, 0.0, 0.1, 0.3, alpha, 0.0, -half_turn, half_turn});
    robot.masses.push_back({5.0, {-0.1, 0.02, 0.03}});
  }
  robot.chain.tool_m = {0.05, 0.02, 0.1};
  return robot;
}

/// Everything of a kind at joint 2, as though it could be seen at this size.
std::vector<NotFound> seen(const std::string& kind) {
  Effect effect{.kind = kind == kOutside ? "coupling" : kind, .joint = 1};
  if (effect.kind == "tool" || effect.kind == "drift" || effect.kind == "sensor_scale") effect.joint = -1;
  if (effect.kind == "coupling") effect.settings["from"] = 3.0;
  if (effect.kind == "compliance") effect.form = "masses";
  if (effect.kind == "backlash") effect.form = "approach";
  if (effect.kind == "tool") effect.form = "position";
  if (effect.kind.starts_with("thermal")) effect.settings["reference_celsius"] = 24.0;
  if (effect.kind == "drift") effect.settings["reference_time_s"] = 0.0;
  const double size = effect.kind == "drift" ? 1e-8 : 1e-5;
  return {{effect, size, ""}};
}

class Kinds : public ::testing::TestWithParam<std::string> {};

TEST_P(Kinds, PutIntoTheSimulatedArmWhatTheirLawSays) {
  const CasePlan plan{3, GetParam(), "small"};
  Scenario scenario = clean_scene(plan, small_arm());
  scenario.joint_errors.clear();
  scenario.noise_m = 0.0;
  const DataSet clean = measured(scenario);
  RandomStream random{17};
  const JustDetectable just = [](const NotFound& measure, const Effect&) { return measure.smallest_detectable; };
  const auto truth =
      draw_truth(GetParam(), seen(GetParam()), scenario.robot, states_of(clean, PoseSet::calibration), just, random);
  ASSERT_TRUE(truth);
  inject(scenario, *truth);
  const DataSet data = measured(scenario);

  CorrectedRobot model = nominal_robot(data);
  model.sensor_from_base = scenario.sensor_from_base;
  const double nominal_mm = error_figures(model, data, poses_of(data, PoseSet::accept)).rms_mm;
  model.effects = {*truth};
  model.described = data.robot;
  const double left_mm = error_figures(model, data, poses_of(data, PoseSet::accept)).rms_mm;
  EXPECT_GT(nominal_mm, 0.0);
  EXPECT_LT(left_mm, 0.02 * nominal_mm) << words(*truth, data.robot);
  EXPECT_NEAR(error_of_truth_mm(scenario, data), 0.0, 1e-9);
  EXPECT_TRUE(is_truth(*truth, *truth, data.robot, states_of(data, PoseSet::calibration)));
}

std::vector<std::string> single_kinds() {
  std::vector<std::string> kinds;
  for (const KindRow& row : kind_table()) {
    if (row.kind != kPair) kinds.push_back(row.kind);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(OfTheTable, Kinds, ::testing::ValuesIn(single_kinds()),
                         [](const auto& kind) { return kind.param; });

TEST(CasePlan, VisitsEveryKindOnEveryArm) {
  std::set<std::pair<std::string, std::string>> met;
  for (const CasePlan& plan : plans(kCases, "")) met.emplace(plan.kind, plan.robot_file);
  EXPECT_EQ(met.size(), 3 * kind_table().size());
  for (const CasePlan& plan : plans(5, "backlash")) EXPECT_EQ(plan.kind, "backlash");
}

TEST(Scene, IsAFunctionOfItsPlan) {
  const CasePlan plan{7, "coupling", "small"};
  const DataSet first = measured(clean_scene(plan, small_arm())), second = measured(clean_scene(plan, small_arm()));
  EXPECT_EQ(poses_of(first, PoseSet::calibration).size(), 100u);
  EXPECT_EQ(poses_of(first, PoseSet::validation).size(), 60u);
  EXPECT_EQ(poses_of(first, PoseSet::accept).size(), 200u);
  for (std::size_t i = 0; i < first.poses.size(); ++i) {
    EXPECT_EQ(*first.poses[i].position_m, *second.poses[i].position_m);
    EXPECT_EQ(first.poses[i].set, second.poses[i].set);
  }
}

class Scores : public ::testing::Test {
 protected:
  static Effect coupling(double from) {
    return {.kind = "coupling", .joint = 1, .settings = {{"from", from}}, .form = "linear"};
  }
  static Round added(const Effect& effect) {
    Round round;
    round.verdict = Verdict::added;
    round.effect = effect;
    return round;
  }
  Score of(const LoopOutcome& outcome, const std::vector<Effect>& found, const std::vector<Effect>& truths) const {
    return score(outcome, found, truths, robot_, {});
  }

  const Robot robot_ = small_arm();
};

TEST_F(Scores, NameACouplingOnlyByBothItsJoints) {
  LoopOutcome outcome;
  outcome.rounds = {added(coupling(3.0))};
  EXPECT_TRUE(of(outcome, {coupling(3.0)}, {coupling(3.0)}).named);
  const Score other = of(outcome, {coupling(3.0)}, {coupling(4.0)});
  EXPECT_FALSE(other.named);
  EXPECT_FALSE(other.in_class);
  EXPECT_TRUE(other.eligible);
  EXPECT_EQ(other.false_additions, 1);
}

TEST_F(Scores, CountRivalsAsTheClassAndCloseOnesAsInseparable) {
  LoopOutcome outcome;
  outcome.rounds = {added(coupling(3.0))};
  outcome.rounds[0].rivals = {{coupling(4.0), 0.8, 3.0}};
  EXPECT_TRUE(of(outcome, {coupling(3.0)}, {coupling(4.0)}).in_class);
  EXPECT_TRUE(of(outcome, {coupling(3.0)}, {coupling(4.0)}).eligible);
  outcome.rounds[0].rivals[0].cosine = 0.95;
  EXPECT_FALSE(of(outcome, {coupling(3.0)}, {coupling(4.0)}).eligible);
  outcome.rounds[0].rivals[0].effect = coupling(3.0);
  outcome.rounds[0].rivals[0].effect.form = "harmonic";
  EXPECT_TRUE(of(outcome, {coupling(3.0)}, {coupling(3.0)}).eligible);
}

TEST_F(Scores, WantBothEffectsOfAPairAndNoneOfAnUnharmedArm) {
  LoopOutcome outcome;
  outcome.rounds = {added(coupling(3.0)), added(coupling(4.0))};
  EXPECT_TRUE(of(outcome, {coupling(3.0), coupling(4.0)}, {coupling(4.0), coupling(3.0)}).named);
  EXPECT_FALSE(of(outcome, {coupling(3.0)}, {coupling(4.0), coupling(3.0)}).named);
  EXPECT_FALSE(of(outcome, {coupling(3.0)}, {}).named);
  EXPECT_TRUE(of({}, {}, {}).named);
}

TEST(Summaries, CountTheNamedAmongThoseThatCanBeTold) {
  CaseFigures told{.plan = {0, "backlash", ""}, .truths = {Effect{}}, .clean = {}, .run = {}}, untold = told;
  told.run.score = {.named = true, .eligible = true, .in_class = true};
  told.run.after_over_floor = 1.0;
  untold.run.score = {.named = false, .eligible = false, .in_class = true};
  untold.run.after_over_floor = 1.2;
  const std::vector<Summary> rows = summaries({told, untold});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].kind, "backlash");
  EXPECT_EQ(rows[0].cases, 2);
  EXPECT_EQ(rows[0].eligible, 1);
  EXPECT_EQ(rows[0].named_eligible, 1);
  EXPECT_EQ(rows[0].in_class, 2);
  EXPECT_NEAR(quantile(rows[0].after_over_floor, 0.5), 1.1, 1e-12);
  EXPECT_EQ(rows[2].kind, "single");
  EXPECT_EQ(rows[2].cases, 2);
}

}  // namespace
}  // namespace demecal::bench
