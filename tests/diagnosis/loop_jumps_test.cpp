// The closed loop on simulated arms of which a joint jumps, and on such that only look as if.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/last_resort.hpp"
#include "simulated_arm.hpp"

namespace demecal {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::Ne;

Scenario arm_that_errs(std::uint64_t seed, int joint, const char* formula) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  scenario.joint_errors = {{joint, parse(formula, {"theta"})}};
  return scenario;
}

TEST(ClosedLoop, NamesASquareWaveByItsTurns) {
  const DataSet data = simulate(arm_that_errs(61, 1, "0.0006 * SIGN(SIN(3 * theta + 0.7))"));
  const LoopResult result = run_loop(data, kZeroed, quick());
  const Effect found = only(result);
  EXPECT_EQ(found.kind, "jump");
  EXPECT_EQ(found.form, "square_wave");
  EXPECT_EQ(found.joint, 1);
  EXPECT_EQ(found.setting("per_turn"), 3.0);
  // It jumps where 3 (q - at) is a multiple of pi, up or down as the height's sign says.
  EXPECT_LT(std::abs(std::remainder(found.setting("at_rad") + 0.7 / 3.0, std::acos(-1.0) / 3.0)),
            found.setting("within_rad"));
  EXPECT_LT(found.setting("within_rad"), 0.05);
  EXPECT_NEAR(std::abs(found.value(0)), 0.0012, 5e-5);
  EXPECT_LT(over_floor(result.model.robot, data), 0.5 * over_floor(result.before.robot, data));
}

TEST(ClosedLoop, NamesAStepByItsPlace) {
  const DataSet data = simulate(arm_that_errs(62, 2, "0.0005 * SIGN(theta - 0.4)"));
  const Effect found = only(run_loop(data, kZeroed, quick()));
  EXPECT_EQ(found.kind, "jump");
  EXPECT_EQ(found.form, "step");
  EXPECT_EQ(found.joint, 2);
  EXPECT_NEAR(found.setting("at_rad"), 0.4, found.setting("within_rad"));
  EXPECT_LT(found.setting("within_rad"), 0.1);
  EXPECT_NEAR(found.value(0), 0.001, 5e-5);
}

TEST(LastResorts, SayWithinWhatTheyMayBeWhereNothingWasMeasured) {
  Scenario scenario = arm_that_errs(62, 2, "0.0005 * SIGN(theta - 0.4)");
  scenario.poses = {120, 60, 40};
  DataSet data = simulate(scenario);
  std::erase_if(data.poses, [](const MeasuredPose& pose) { return std::abs(pose.joints[2] - 0.3) < 0.3; });
  const DiagnosisProblem problem{data, kZeroed, poses_of(data, PoseSet::calibration), {}};
  const Evidence evidence = evidence_of(data, problem.fitted);
  const DiagnosedModel model =
      diagnosed_model(problem, fit_declared(data, problem.fitted, kZeroed, nominal_robot(data)));
  std::vector<Candidate> known;
  const std::vector<std::string> kinds{"jump"};
  EXPECT_TRUE(add_last_resorts({problem, evidence, kinds, 0.05, 99}, model, linearize(problem, model),
                               RandomStream{62, 1}, known));
  const auto found = std::ranges::find(known, 2, [](const Candidate& candidate) { return candidate.effect.joint; });
  ASSERT_NE(found, known.end());
  EXPECT_EQ(found->effect.form, "step");
  EXPECT_NEAR(found->effect.setting("at_rad"), 0.3, 0.1);
  EXPECT_GT(found->effect.setting("within_rad"), 0.3);
  EXPECT_LT(found->effect.setting("within_rad"), 0.45);
}

TEST(ClosedLoop, TakesNoWavesForJumps) {
  for (const std::uint64_t seed : {49, 63}) {
    Scenario scenario = perfect_scenario(parallel_arm(), seed);
    scenario.poses = {200, 60, 40};
    for (int joint = 0; joint < 6; ++joint)
      scenario.joint_errors.push_back({joint, parse("0.0008*SIN(theta*theta+" + std::to_string(joint) + ")")});
    const LoopResult result = run_loop(simulate(scenario), kZeroed, quick());
    EXPECT_THAT(result.model.robot.effects, Each(Field(&Effect::kind, Ne("jump")))) << seed;
  }
}

TEST(ClosedLoop, LooksForNoJumpWhereOthersAreAskedFor) {
  LoopOptions options = quick();
  options.kinds = {"backlash", "gear_harmonic"};
  const DataSet data = simulate(arm_that_errs(62, 2, "0.0005 * SIGN(theta - 0.4)"));
  EXPECT_THAT(run_loop(data, kZeroed, options).model.robot.effects, Each(Field(&Effect::kind, Ne("jump"))));
}

}  // namespace
}  // namespace demecal
