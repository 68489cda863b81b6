// What validation poses, resampling and the size of its motion say of an effect, and how often they are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/judgement.hpp"
#include "residuals/measured_arm.hpp"
#include "simulated_arm.hpp"

namespace demecal {
namespace {

std::vector<std::size_t> each_alone(std::size_t poses) {
  std::vector<std::size_t> groups(poses);
  std::iota(groups.begin(), groups.end(), 0);
  return groups;
}

TEST(ToolErrors, AreLengthsOfPositionRowsInMillimetres) {
  RandomStream stream{87, 1};
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  measure_anyhow(arm, stream, {.noise_m = 1e-4}, 3);
  measure_anyhow(arm, stream, {.noise_m = 1e-4, .noise_rad = 1e-3, .orientation = true}, 3);
  arm.data.anchors_m = {random_vector(stream, 3.0), random_vector(stream, 3.0)};
  measure_anyhow(arm, stream, {.noise_m = 1e-4, .position = false}, 2);
  const ResidualField field = field_of(arm, {});
  const std::vector<double> errors = tool_errors_mm(field, field.residual, kScales, arm.data);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_NEAR(errors[i], 1e3 * tool_error_m(arm.truth, arm.data, arm.data.poses[i]), 1e-9) << i;
  }
}

TEST(WholeErrors, AreThoseOfPositionWhereNothingElseWasMeasured) {
  RandomStream stream{87, 2};
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  measure_anyhow(arm, stream, {.noise_m = 1e-4}, 4);
  measure_anyhow(arm, stream, {.orientation = true}, 1);
  ResidualField field = field_of(arm, {});
  field.residual.tail(6).setConstant(2.0);
  const std::vector<double> whole = pose_errors_mm(field, field.residual, kScales);
  const std::vector<double> position = tool_errors_mm(field, field.residual, kScales, arm.data);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(whole[i], position[i]);
  EXPECT_DOUBLE_EQ(whole[4], 1e3 * kScales[kPosition] * 2.0 * std::sqrt(3.0));
}

/// What 40 poses make of a change of `size` in one direction, of which `there` times as much is in their residuals,
/// beside unit noise.
Confirmation confirmation_of(double there, double size, RandomStream& stream, std::uint64_t draw) {
  std::vector<double> before, after, moved;
  for (int i = 0; i < 40; ++i) {
    const double change = size * stream.normal();
    const Eigen::Vector3d noise(stream.normal(), stream.normal(), stream.normal());
    const Eigen::Vector3d residual = noise + there * change * Eigen::Vector3d::UnitX();
    before.push_back(residual.norm());
    after.push_back((residual - change * Eigen::Vector3d::UnitX()).norm());
    moved.push_back(std::abs(change));
  }
  return confirmation(before, after, moved, each_alone(before.size()), RandomStream{87, 4, draw});
}

TEST(Confirmation, IsWholeWhereTheResidualGoesAndNoneWhereNothingMoves) {
  const std::vector<double> before(40, 0.5), nothing(40, 0.0);
  const Confirmation whole = confirmation(before, nothing, before, each_alone(before.size()), RandomStream{1});
  EXPECT_NEAR(whole.share, 1.0, 1e-12);
  EXPECT_NEAR(whole.lower, 1.0, 1e-12);
  EXPECT_EQ(confirmation(before, before, nothing, each_alone(before.size()), RandomStream{1}).share, 0.0);
  EXPECT_EQ(confirmation({}, {}, {}, {}, RandomStream{1}).lower, 0.0);
}

TEST(Confirmation, IsTheShareThatIsThereOnAverage) {
  RandomStream stream{87, 11};
  for (const double there : {0.0, 0.5, 1.0}) {
    double sum = 0.0;
    for (std::uint64_t set = 0; set < 200; ++set) sum += confirmation_of(there, 0.5, stream, set).share;
    EXPECT_NEAR(sum / 200, there, 0.08);
  }
}

TEST(Confirmation, BoundIsBelowTheTruthNineteenTimesInTwenty) {
  RandomStream stream{87, 3};
  constexpr int kSets = 400;
  int below = 0;
  for (std::uint64_t set = 0; set < kSets; ++set) below += confirmation_of(0.6, 1.0, stream, set).lower < 0.6;
  EXPECT_GE(below, 0.91 * kSets);
  EXPECT_LE(below, 0.98 * kSets);
}

TEST(Confirmation, IsNotDecidedByOnePoseFarOut) {
  std::vector<double> before(30, 1.0), after(30, 1.05);
  const std::vector<double> moved(30, 0.1);
  before[7] = 20.0;
  after[7] = 19.9;
  EXPECT_LT(confirmation(before, after, moved, each_alone(before.size()), RandomStream{1}).lower, 0.0);
}

TEST(Confirmation, RepeatsAreDrawnTogether) {
  std::vector<double> before, after, moved;
  std::vector<std::size_t> alone, together;
  RandomStream stream{87, 9};
  for (int pose = 0; pose < 10; ++pose) {
    const double fall = 0.02 + 0.1 * stream.normal();
    for (int repeat = 0; repeat < 4; ++repeat) {
      alone.push_back(before.size());
      together.push_back(static_cast<std::size_t>(4 * pose));
      before.push_back(1.0);
      after.push_back(std::sqrt(1.0 - fall));
      moved.push_back(0.1);
    }
  }
  EXPECT_LT(confirmation(before, after, moved, together, RandomStream{1}).lower,
            confirmation(before, after, moved, alone, RandomStream{1}).lower);
}

struct Noisy {
  ResidualField field;
  Projection::Trial trial;
};

/// Backlash of joint 2, so many standard errors wide.
Noisy noisy_backlash(RandomStream& stream, double standard_errors) {
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  measure_anyhow(arm, stream, {}, 60);
  Noisy made{field_of(arm, {.registration = true}), {}};
  const RowMatrix column =
      columns_of({{.kind = "backlash", .joint = 1, .settings = {}, .form = "approach"}}, arm.data.robot, made.field)
          .dense(made.field, 0);
  const Projection::Trial alone = projection_of(made.field).trial(column, column);
  renew_noise(made.field, stream);
  made.field.residual += column * (standard_errors / alone.fitted.norm());
  made.trial = projection_of(made.field).trial(column, column);
  return made;
}

Resampled resample(const Noisy& tested, std::uint64_t seed) {
  return resampled(tested.field, tested.trial, projection_of(tested.field).residual(), 400, RandomStream{87, seed});
}

TEST(Resampled, IntervalIsAboutFourStandardErrorsWide) {
  RandomStream stream{87, 5};
  double width = 0.0;
  constexpr int kJudgedArms = 10;
  for (int i = 0; i < kJudgedArms; ++i) {
    const Noisy tested = noisy_backlash(stream, 8.0);
    const auto [lower, upper] = resample(tested, 6).interval[0];
    EXPECT_LT(lower, tested.trial.coefficients[0]);
    EXPECT_GT(upper, tested.trial.coefficients[0]);
    width += (upper - lower) * tested.trial.fitted.norm() / kJudgedArms;
  }
  EXPECT_NEAR(width, 3.92, 0.6);
}

TEST(Resampled, SignIsStableWhereTheEffectIsThereAndNotWhereItIsNot) {
  RandomStream stream{87, 7};
  EXPECT_EQ(resample(noisy_backlash(stream, 8.0), 8).sign_stability, 1.0);
  const Noisy tested = noisy_backlash(stream, 0.0);
  const double in_errors = std::abs(tested.trial.coefficients[0]) * tested.trial.fitted.norm();
  const double expected = 0.5 * std::erfc(-in_errors / std::sqrt(2.0));
  EXPECT_LT(in_errors, 1.6);
  EXPECT_NEAR(resample(tested, 9).sign_stability, expected, 0.1);
}

TEST(Resampled, IsAFunctionOfItsSeed) {
  RandomStream stream{87, 10};
  const Noisy tested = noisy_backlash(stream, 2.0);
  EXPECT_EQ(resample(tested, 11).interval, resample(tested, 11).interval);
  EXPECT_NE(resample(tested, 11).interval, resample(tested, 12).interval);
}

TEST(LargestMotion, IsHowFarAnEffectStraysFromItsMean) {
  RandomStream stream{87, 13};
  const Robot robot = laden_arm(stream, Arm::sliding_standard);
  std::vector<ArmState> states;
  for (const double sign : {1.0, -1.0, 1.0, -1.0}) {
    states.push_back(arm_state(robot, random_stop(stream, robot)));
    states.back().stop.approach.setConstant(sign);
  }
  const auto backlash = [](int joint, double width) {
    return Effect{.kind = "backlash", .joint = joint, .settings = {}, .form = "approach", .values = {width}};
  };
  EXPECT_NEAR(largest_motion(backlash(1, 6e-4), robot, states).turn_rad, 3e-4, 1e-15);
  EXPECT_EQ(largest_motion(backlash(1, 6e-4), robot, states).shift_m, 0.0);
  EXPECT_NEAR(largest_motion(backlash(2, 6e-4), robot, states).shift_m, 3e-4, 1e-15);
  const Effect offset{.kind = "joint_offset", .joint = 1, .values = {0.1}};
  EXPECT_NEAR(largest_motion(offset, robot, states).turn_rad, 0.0, 1e-15);
  EXPECT_EQ(largest_motion(offset, robot, {}).turn_rad, 0.0);
  EXPECT_NEAR(farthest_motion(offset, robot, states).turn_rad, 0.1, 1e-15);
  EXPECT_NEAR(farthest_motion(backlash(2, 6e-4), robot, states).shift_m, 3e-4, 1e-15);
}

using ::testing::HasSubstr;

/// Measured by a controller that reports joint 3 against the horizontal: its true angle is q3 + sign q2.
DataSet reported_against_horizontal(double sign, std::uint64_t seed) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  DataSet data = simulate(scenario);
  for (MeasuredPose& pose : data.poses) pose.joints[2] -= sign * pose.joints[1];
  return data;
}

TEST(UnitCoupling, IsNamedAndNoBound) {
  for (const double sign : {1.0, -1.0}) {
    const DataSet data = reported_against_horizontal(sign, 71);
    const LoopOutcome outcome = run_loop(data, kZeroed, quick()).outcome;
    const auto coupling = std::ranges::find_if(
        outcome.rounds, [](const Round& round) { return round.reason.starts_with("the data show a unit coupling"); });
    ASSERT_NE(coupling, outcome.rounds.end()) << sign;
    EXPECT_TRUE(coupling->implausible);
    EXPECT_THAT(coupling->reason,
                HasSubstr("joint 3 turns with joint 2, by " + std::string(sign > 0 ? "1.000" : "-1.000")));
    EXPECT_THAT(coupling->reason, HasSubstr(sign > 0 ? "write its column as q3 + q2" : "write its column as q3 - q2"));
    for (const NotFound& missing : outcome.not_found) {
      const bool it = missing.effect.same_law_as(coupling->effect);
      EXPECT_FALSE(it) << "what the data hold is not bounded";
      if (missing.effect.kind != "coupling" || missing.unit != "1" || !missing.testable) continue;
      EXPECT_LT(missing.smallest_detectable, 0.05);
    }
  }
}

TEST(Limits, AreTestableInGoodDataAndNotWhereTheErrorIsHuge) {
  const DataSet good = simulate(perfect_scenario(parallel_arm(), 72));
  const LoopOutcome clean = run_loop(good, kZeroed, quick()).outcome;
  const auto tested = [](const LoopOutcome& outcome, const char* kind) {
    return std::ranges::count_if(
        outcome.not_found, [kind](const NotFound& missing) { return missing.effect.kind == kind && missing.testable; });
  };
  EXPECT_GE(tested(clean, "backlash"), 5);
  DataSet bad = good;  // a different error at every pose, of a third of a metre
  RandomStream random{72, 1};
  for (MeasuredPose& pose : bad.poses)
    *pose.position_m += 0.3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  const LoopOutcome loud = run_loop(bad, kZeroed, quick()).outcome;
  EXPECT_EQ(tested(loud, "backlash"), 0);
  EXPECT_FALSE(loud.not_found.empty());
}

}  // namespace
}  // namespace demecal
