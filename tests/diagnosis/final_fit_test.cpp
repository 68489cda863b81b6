// The last fit: validation poses count too where accept poses are left to tell the error, and accept poses never do.
#include "diagnosis/loop.hpp"

#include <gtest/gtest.h>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

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
