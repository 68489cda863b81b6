// The backward step takes back what is not needed; the last fit takes all poses that had a part in choosing.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/loop.hpp"
#include "residuals/measured_arm.hpp"
#include "simulated_arm.hpp"

namespace demecal {
namespace {

const Effect kBacklash{.kind = "backlash", .joint = 1, .settings = {}, .form = "approach", .values = {4e-4}};
const Effect kHeat{.kind = "thermal_offset", .joint = 3, .settings = {{"reference_celsius", 28}}, .values = {0.0}};
const Effect kGear{.kind = "gear_harmonic", .joint = 2, .settings = {{"ratio", 9}}, .values = {0.0, 0.0}};

/// An arm with backlash in joint 2, measured 80 times.
KnownArm loose_arm(RandomStream& stream) {
  KnownArm arm = arm_of(stream, laden_arm(stream, Arm::standard));
  arm.truth.effects = {kBacklash};
  measure_anyhow(arm, stream, {.noise_m = 5e-5}, 80);
  return arm;
}

/// The true arm with these effects instead of its own, at the least-squares values.
DiagnosedModel model_with(const DiagnosisProblem& problem, const KnownArm& arm, std::vector<Effect> effects) {
  DiagnosedModel model{arm.truth, smooth_corrections(arm.data, problem.fitted, arm.truth, false), kScales};
  model.robot.effects = std::move(effects);
  return refined(problem, std::move(model), 4);
}

std::vector<Candidate> as_candidates(const std::vector<Effect>& effects) {
  std::vector<Candidate> candidates;
  for (const Effect& effect : effects) candidates.push_back({.effect = effect, .naming_cost_nats = 2.0});
  return candidates;
}

TEST(Refined, FindsCoefficientsWithHonestStandardErrors) {
  RandomStream stream{90, 1};
  double squares = 0.0;
  constexpr int kRefittedArms = 12;
  for (int i = 0; i < kRefittedArms; ++i) {
    const KnownArm arm = loose_arm(stream);
    const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
    Effect unknown = kBacklash;
    unknown.values.clear();
    const DiagnosedModel model = model_with(problem, arm, {unknown});
    const Effect& found = model.robot.effects[0];
    ASSERT_EQ(found.standard_errors.size(), 1u);
    squares += std::pow((found.values[0] - 4e-4) / found.standard_errors[0], 2) / kRefittedArms;
    EXPECT_NEAR(model.scales[kPosition], 5e-5, 1e-5);
  }
  EXPECT_GT(squares, 0.3);
  EXPECT_LT(squares, 2.5);
}

TEST(Refined, IsNotMovedByAPoseFarOut) {
  RandomStream stream{90, 2};
  KnownArm arm = loose_arm(stream);
  const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
  const double before = model_with(problem, arm, {kBacklash}).robot.effects[0].values[0];
  *arm.data.poses[5].position_m += Eigen::Vector3d(0.05, 0.0, 0.02);
  const DiagnosedModel model = model_with(problem, arm, {kBacklash});
  EXPECT_NEAR(model.robot.effects[0].values[0], before, 2 * model.robot.effects[0].standard_errors[0]);
  EXPECT_LT(linearize(problem, model).fitted.root_weight[5], 0.2);
}

TEST(BackwardStep, TakesBackWhatIsNeedlessAndKeepsWhatIsNot) {
  RandomStream stream{90, 3};
  const KnownArm arm = loose_arm(stream);
  const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
  DiagnosedModel model = model_with(problem, arm, {kHeat, kBacklash, kGear});
  LoopOutcome outcome;
  for (const Effect& effect : {kHeat, kBacklash, kGear}) {
    outcome.rounds.emplace_back().verdict = Verdict::added;
    outcome.rounds.back().effect = effect;
  }
  const Linearization linearization =
      eliminate_backward(problem, model, as_candidates({kHeat, kBacklash, kGear}), outcome);
  ASSERT_EQ(model.robot.effects.size(), 1u);
  EXPECT_TRUE(model.robot.effects[0].same_law_as(kBacklash));
  EXPECT_NEAR(model.robot.effects[0].values[0], 4e-4, 4 * model.robot.effects[0].standard_errors[0]);
  EXPECT_EQ(outcome.dropped.size(), 2u);
  EXPECT_EQ(outcome.rounds[0].verdict, Verdict::rejected);
  EXPECT_EQ(outcome.rounds[1].verdict, Verdict::added);
  EXPECT_EQ(outcome.rounds[2].verdict, Verdict::rejected);
  EXPECT_FALSE(outcome.rounds[0].reason.empty());
  EXPECT_EQ(linearization.ids.back().kind, ParameterId::Kind::effect);
  EXPECT_EQ(linearization.changes.size(), static_cast<Eigen::Index>(linearization.ids.size()));
}

TEST(BackwardStep, LeavesAModelOfNeededEffectsAsItIs) {
  RandomStream stream{90, 4};
  const KnownArm arm = loose_arm(stream);
  const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
  DiagnosedModel model = model_with(problem, arm, {kBacklash});
  const std::vector<double> before = model.robot.effects[0].values;
  LoopOutcome outcome;
  eliminate_backward(problem, model, as_candidates({kBacklash}), outcome);
  EXPECT_EQ(model.robot.effects[0].values, before);
  EXPECT_TRUE(outcome.dropped.empty());
}

/// Weight turns no joint's place about an axis that is upright.
TEST(BackwardStep, KeepsAnEffectOfWhichPosesTellOnlyAPart) {
  RandomStream stream{90, 6};
  Robot robot = laden_arm(stream, Arm::standard);
  robot.chain.base = Eigen::Isometry3d::Identity();
  robot.gravity_mps2 = -9.81 * Eigen::Vector3d::UnitY();
  KnownArm arm = arm_of(stream, robot);
  Effect bending{.kind = "link_bending", .joint = 0, .form = "masses", .values = {4e-6, 0.0}};
  arm.truth.effects = {bending};
  measure_anyhow(arm, stream, {.noise_m = 5e-5}, 80);
  const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
  bending.values.clear();
  DiagnosedModel model = model_with(problem, arm, {bending});
  LoopOutcome outcome;
  eliminate_backward(problem, model, as_candidates({bending}), outcome);
  ASSERT_EQ(model.robot.effects.size(), 1u);
  const Effect& found = model.robot.effects[0];
  EXPECT_NEAR(found.values[0], 4e-6, 4 * found.standard_errors[0]);
  EXPECT_LT(std::abs(found.values[1]), 4e-6) << "nothing is made of what no pose tells";
  EXPECT_GT(found.standard_errors[1], 1.0);
}

TEST(LeavesMore, IsSaidOfAModelThatErrsClearlyMoreWhateverAPoseFarOutSays) {
  RandomStream stream{90, 5};
  KnownArm arm = loose_arm(stream);
  const DiagnosisProblem problem{arm.data, kPlacedAndZeroed, all_poses(arm.data), {}};
  const DiagnosedModel with = model_with(problem, arm, {kBacklash}), without = model_with(problem, arm, {});
  for (const double off_m : {0.0, 0.1}) {
    if (off_m > 0.0) *arm.data.poses[7].position_m += Eigen::Vector3d(off_m, 0.0, 0.0);
    EXPECT_TRUE(leaves_more(problem, without, with)) << off_m;
    EXPECT_FALSE(leaves_more(problem, with, without)) << off_m;
    EXPECT_FALSE(leaves_more(problem, with, with)) << off_m;
  }
}

constexpr DeclaredModel kDeclared{
    .registration = true, .tool = true, .joint_offset = true, .geometry = false, .joint_corrections = true};

DataSet waving_arm(std::uint64_t seed) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  for (int joint = 0; joint < scenario.robot.chain.size(); ++joint) {
    scenario.joint_errors.push_back({joint, parse("0.0008 * SIN(theta + 0." + std::to_string(joint) + ")")});
  }
  return simulate(scenario);
}

DiagnosedModel fitted(const DataSet& data) {
  const DiagnosisProblem problem{data, kDeclared, poses_of(data, PoseSet::calibration), {}};
  return refined(problem, diagnosed_model(problem, fit_declared(data, problem.fitted, kDeclared, nominal_robot(data))),
                 12);
}

Eigen::Vector3d reached(const DiagnosedModel& model, const MeasuredPose& pose) {
  return model.robot.predict(pose.joints, "").translation();
}

TEST(FinalFit, LowersTheErrorOnAcceptPosesOnTheWhole) {
  double before = 0.0, after = 0.0;
  for (std::uint64_t seed = 31; seed < 39; ++seed) {
    const DataSet data = waving_arm(seed);
    const DiagnosedModel model = fitted(data);
    before += over_floor(model.robot, data);
    after += over_floor(final_fit(data, kDeclared, model).robot, data);
  }
  EXPECT_LT(after, before);
}

/// Root mean square of the tool errors of all poses that a last fit has.
double own_error_m(const DiagnosedModel& model, const DataSet& data) {
  double squares = 0.0;
  const std::vector<std::size_t> poses = poses_of_last_fit(data);
  for (const std::size_t pose : poses) squares += std::pow(tool_error_m(model.robot, data, data.poses[pose]), 2);
  return std::sqrt(squares / static_cast<double>(poses.size()));
}

/// Noise believed to be a thousand times as large as it is leaves no correction relevant: that fit is not taken.
TEST(FinalFit, NeverMakesItsOwnPosesMoreThanATwentiethWorse) {
  for (std::uint64_t seed = 43; seed < 47; ++seed) {
    const DataSet data = waving_arm(seed);
    const DiagnosedModel model = fitted(data);
    DiagnosedModel doubting = model;
    doubting.noise_estimated = true;
    for (double& scale : doubting.scales) scale *= 1e3;
    const DiagnosisProblem all{data, kDeclared, poses_of_last_fit(data), {}};
    EXPECT_GT(own_error_m(refined(all, doubting, 12), data), 2.0 * own_error_m(model, data)) << seed;
    EXPECT_LE(own_error_m(final_fit(data, kDeclared, doubting), data), 1.05 * own_error_m(model, data)) << seed;
    EXPECT_LE(own_error_m(final_fit(data, kDeclared, model), data), 1.05 * own_error_m(model, data)) << seed;
  }
}

TEST(FinalFit, DoesNotSeeAcceptPoses) {
  DataSet data = waving_arm(41);
  const DiagnosedModel model = fitted(data);
  const DiagnosedModel honest = final_fit(data, kDeclared, model);
  for (const std::size_t pose : poses_of(data, PoseSet::accept)) *data.poses[pose].position_m *= 1.01;
  const DiagnosedModel again = final_fit(data, kDeclared, model);
  for (const MeasuredPose& pose : data.poses) EXPECT_EQ(reached(honest, pose), reached(again, pose));
}

TEST(FinalFit, LeavesTheModelWhereNoAcceptPosesTellItsError) {
  DataSet data = waving_arm(42);
  for (MeasuredPose& pose : data.poses) {
    if (pose.set == PoseSet::accept) pose.set = PoseSet::validation;
  }
  const DiagnosedModel model = fitted(data);
  const DiagnosedModel last = final_fit(data, kDeclared, model);
  for (const MeasuredPose& pose : data.poses) EXPECT_EQ(reached(model, pose), reached(last, pose));
  EXPECT_EQ(poses_of_last_fit(data), poses_of(data, PoseSet::calibration));
}

}  // namespace
}  // namespace demecal
