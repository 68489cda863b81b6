// The closed loop on data of every kind: few poses, more joints, less recorded, other instruments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Scenario loose_arm(const Chain& chain, std::uint64_t seed) {
  Scenario scenario = perfect_scenario(chain, seed);
  scenario.backlash = {{1, 8e-4}};
  return scenario;
}

/// Effects of a kind and joint among those added.
std::ptrdiff_t count_added(const LoopResult& result, const std::string& kind, int joint) {
  return std::ranges::count_if(added(result.outcome),
                               [&](const Effect& effect) { return effect.kind == kind && effect.joint == joint; });
}

void expect_sound(const LoopOutcome& outcome) {
  EXPECT_NE(outcome.stopped, StopReason::not_run);
  EXPECT_GT(outcome.p_structure_left, 0.0);
  EXPECT_LE(outcome.p_structure_left, 1.0);
  for (const Round& round : outcome.rounds) {
    EXPECT_GT(round.p_family, 0.0);
    EXPECT_TRUE(std::isfinite(round.gain_nats) && std::isfinite(round.confirmed));
    EXPECT_FALSE(round.diagnosis.empty() || round.formula.empty());
    EXPECT_EQ(round.reason.empty(), round.verdict == Verdict::added);
    for (const double value : round.effect.values) EXPECT_TRUE(std::isfinite(value));
    if (round.verdict != Verdict::added) continue;
    for (const double error : round.effect.standard_errors) EXPECT_TRUE(std::isfinite(error) && error > 0.0);
  }
  for (const NotFound& each : outcome.not_found) EXPECT_TRUE(std::isfinite(each.smallest_detectable) || !each.testable);
}

std::vector<std::string> unseen(const LoopOutcome& outcome) {
  std::vector<std::string> kinds;
  for (const UntestableKind& each : outcome.untestable) kinds.push_back(each.kind);
  return kinds;
}

/// Two upright joints, a slide that hangs upside down but for `tilt_rad`, and a joint about it.
Chain hanging_slide_arm(double tilt_rad) {
  constexpr auto r = JointType::revolute;
  return {Convention::standard_dh,
          {link(r, 0, 0.325, 0.387), link(r, 2 * kRight + tilt_rad, 0.275, 0), link(JointType::prismatic, 0, 0, 0),
           link(r, 0, 0, 0)},
          {0.06, 0.02, 0.04}};
}

TEST(ClosedLoopData, MayBeOfAxesThatAreParallelButForATrace) {
  LoopOptions options = quick();
  options.max_effects = 0;
  for (const double tilt_deg : {0.0, 1e-8, 3e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3}) {
    const DataSet data = simulate(perfect_scenario(hanging_slide_arm(tilt_deg * kRight / 90), 24));
    const Fit fit = fit_declared(data, poses_of(data, PoseSet::calibration), kAll, nominal_robot(data));
    EXPECT_EQ(fit.status, FitStatus::converged) << tilt_deg;
    EXPECT_LT(over_floor(fit.robot, data), 1.3) << tilt_deg;
    EXPECT_LT(over_floor(close_loop(data, kAll, fit, options).before.robot, data), 1.3) << tilt_deg;
  }
}

TEST(ClosedLoopData, MayBeFifteenPoses) {
  Scenario scenario = loose_arm(parallel_arm(), 1);
  const auto expect_sound_run = [&](std::array<int, 3> poses, const DeclaredModel& declared) {
    scenario.poses = poses;
    const LoopResult result = run_loop(simulate(scenario), declared, quick());
    expect_sound(result.outcome);
    EXPECT_LE(result.model.robot.effects.size(), 3u);
  };
  expect_sound_run({15, 0, 0}, kZeroed);
  expect_sound_run({10, 5, 0}, {.registration = true});
  expect_sound_run({10, 5, 0}, {.registration = true, .tool = true, .joint_offset = true, .geometry = true});
}

TEST(ClosedLoopData, MayBeFifteenPosesOfAModelWithManyMoreNumbers) {
  Scenario scenario = loose_arm(stanford_arm(), 13);
  scenario.poses = {15, 0, 0};
  const DeclaredModel declared{.registration = true, .joint_offset = true, .geometry = true, .joint_corrections = true};
  expect_sound(run_loop(simulate(scenario), declared, quick()).outcome);
}

TEST(ClosedLoopData, MayBeOfAnArmWithSevenJoints) {
  const LoopResult result = run_loop(simulate(loose_arm(seven_joint_arm(), 14)), kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
}

TEST(ClosedLoopData, MayBeOfAnArmWithASlidingJoint) {
  Scenario scenario = perfect_scenario(stanford_arm(), 3);
  scenario.backlash = {{2, 8e-4}};
  const LoopResult result = run_loop(simulate(scenario), kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 2), 1);
}

TEST(ClosedLoopData, MayBeFullPoses) {
  Scenario scenario = loose_arm(parallel_arm(), 15);
  scenario.orientation_measured = true;
  scenario.orientation_noise_rad = 1e-4;
  const LoopResult result = run_loop(simulate(scenario), kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
  EXPECT_NEAR(result.model.scales[kOrientation], 1e-4, 2e-5);
}

TEST(ClosedLoopData, MayBeDistances) {
  DataSet data = simulate(loose_arm(parallel_arm(), 5));
  data.anchors_m = {{3, 0, 1}, {-2, 2.5, 0}, {0, -3, 2}, {0.5, 0.5, 4}};
  for (MeasuredPose& pose : data.poses) {
    for (const Eigen::Vector3d& anchor : data.anchors_m) pose.distances_m.push_back((*pose.position_m - anchor).norm());
    pose.position_m.reset();
  }
  const LoopResult result = run_loop(data, kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
}

TEST(ClosedLoopData, MayHaveNoValidationPoses) {
  Scenario scenario = loose_arm(parallel_arm(), 6);
  scenario.poses = {80, 0, 40};
  const DataSet data = simulate(scenario);
  const LoopResult result = run_loop(data, kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
  EXPECT_LT(over_floor(result.model.robot, data), 1.2);
}

TEST(ClosedLoopData, WithoutCircumstancesSayWhatTheyCannotShow) {
  Scenario scenario = loose_arm(parallel_arm(), 7);
  scenario.approach_recorded = false;
  scenario.payloads_kg.clear();
  scenario.seconds_per_pose = 0.0;
  scenario.temperature.reset();
  DataSet data = simulate(scenario);
  data.robot.masses.clear();
  const LoopResult result = run_loop(data, kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 0);
  EXPECT_THAT(unseen(result.outcome),
              UnorderedElementsAre("backlash", "hysteresis", "thermal_offset", "thermal_length", "drift"));
  for (const NotFound& each : result.outcome.not_found) {
    EXPECT_THAT(unseen(result.outcome), ::testing::Not(Contains(each.effect.kind)));
  }
}

TEST(ClosedLoopData, AreOnlyAskedForTheKindsWanted) {
  const DataSet data = simulate(loose_arm(parallel_arm(), 8));
  LoopOptions options = quick();
  options.kinds = {"thermal_offset", "gain"};
  const LoopResult result = run_loop(data, kZeroed, options);
  expect_sound(result.outcome);
  for (const Round& round : result.outcome.rounds) {
    EXPECT_TRUE(round.effect.kind == "thermal_offset" || round.effect.kind == "gain");
  }
  EXPECT_EQ(result.outcome.candidates, 12);
  EXPECT_EQ(result.outcome.considered, options.kinds);
}

/// A scale of the instrument is one of all lengths, which declared links hold.
TEST(ClosedLoopData, SayWhichKindsTheDeclaredModelHolds) {
  const DataSet data = simulate(loose_arm(parallel_arm(), 8));
  DeclaredModel links = kZeroed;
  links.tool = links.geometry = true;
  EXPECT_THAT(unseen(run_loop(data, links, quick()).outcome), Contains("sensor_scale"));
  EXPECT_THAT(unseen(run_loop(data, kZeroed, quick()).outcome), ::testing::Not(Contains("sensor_scale")));
}

TEST(ClosedLoopData, GiveTheFloorWherePosesAreRepeated) {
  Scenario scenario = loose_arm(parallel_arm(), 9);
  scenario.backlash = {};
  scenario.couplings = {{.joint = 2, .from = 1, .per_rad = 3e-4}};
  scenario.repeats = 3;
  const LoopResult result = run_loop(simulate(scenario), kZeroed, quick());
  expect_sound(result.outcome);
  ASSERT_TRUE(result.outcome.repeat_scatter_m && result.outcome.lack_of_fit_p && result.outcome.explained_share);
  EXPECT_NEAR(*result.outcome.repeat_scatter_m, kNoise_m, 5e-6);
  EXPECT_LT(*result.outcome.lack_of_fit_p, 0.01);
  EXPECT_GT(*result.outcome.explained_share, 0.9);
  EXPECT_LT(*result.outcome.explained_share, 1.05);
}

TEST(ClosedLoopData, GiveNoFloorWithoutRepeats) {
  const LoopOutcome outcome = run_loop(simulate(loose_arm(parallel_arm(), 10)), kZeroed, quick()).outcome;
  EXPECT_FALSE(outcome.repeat_scatter_m || outcome.lack_of_fit_p || outcome.explained_share);
}

TEST(ClosedLoopData, FarOutAreNamedAndDoNotDecide) {
  Scenario scenario = loose_arm(parallel_arm(), 11);
  DataSet data = simulate(scenario);
  for (const std::size_t pose : {7, 30}) *data.poses[pose].position_m += Eigen::Vector3d(0.006, -0.004, 0.003);
  const LoopResult result = run_loop(data, kZeroed, quick());
  expect_sound(result.outcome);
  EXPECT_THAT(result.outcome.outliers, UnorderedElementsAre(7, 30));
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
  EXPECT_LT(over_floor(result.model.robot, data), 1.2);
}

TEST(ClosedLoopData, MayBeDescribedByAModelOfNothing) {
  Scenario scenario = loose_arm(parallel_arm(), 12);
  const LoopResult result = run_loop(simulate(scenario), {}, quick());
  expect_sound(result.outcome);
  EXPECT_EQ(count_added(result, "backlash", 1), 1);
}

}  // namespace
}  // namespace demecal
