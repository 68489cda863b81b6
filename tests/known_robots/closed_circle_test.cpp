// The circle with effects in the model: the robot is sent to corrected joints, and found where the model says.
#include <gtest/gtest.h>

#include <cmath>

#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

struct Found {
  double predicted_rms_mm = 0.0;  ///< the model's error on poses it never saw
  double found_rms_mm = 0.0;      ///< from the desired point to where the corrected robot was measured
  double uncorrected_rms_mm = 0.0;
};

/// Sends the robot to the accept poses again, corrected for how each is approached, and measures.
Found measured_again(const Scenario& scenario, const DataSet& data, const CorrectedRobot& model) {
  const SimulatedRobot real(scenario);
  RandomStream random{scenario.seed, 98};
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  double found = 0.0, uncorrected = 0.0;
  for (const std::size_t index : accept) {
    const MeasuredPose& pose = data.poses[index];
    const Eigen::Vector3d goal =
        (model.sensor_from_base * forward(data.robot.chain, pose.joints) * model.tool(pose.target)).translation();
    const InverseSolution command = corrected_command(model, data.robot.chain, Stop(pose));
    EXPECT_EQ(command.status, InverseStatus::converged);
    const Eigen::Vector3d predicted = model.predict(Stop(pose).with_joints(command.q), pose.target).translation();
    EXPECT_LT((predicted - goal).norm(), 1e-6);
    const MeasuredPose again = real.measure(command.q, *pose.approach, 0.0, random);
    found += (*again.position_m - goal).squaredNorm();
    uncorrected += (*pose.position_m - goal).squaredNorm();
  }
  const double n = static_cast<double>(accept.size());
  return {error_figures(model, data, accept).rms_mm, 1e3 * std::sqrt(found / n), 1e3 * std::sqrt(uncorrected / n)};
}

TEST(ClosedCircle, PredictedAndFoundErrorAgreeWithinTheNoise) {
  const Scenario scenario = lacking_puma(true);
  const DataSet data = simulate(scenario);
  const CalibrateResult result = calibrate_in_memory(data, short_looping_job());
  ASSERT_FALSE(result.model.robot.effects.empty());
  const Found found = measured_again(scenario, data, result.model.robot);
  const double noise_mm = 1e3 * scenario.noise_m * std::sqrt(3.0);
  EXPECT_NEAR(found.found_rms_mm, found.predicted_rms_mm, 0.5 * noise_mm);
  EXPECT_LT(found.found_rms_mm, 1.5 * noise_mm);
  EXPECT_LT(found.found_rms_mm, 0.2 * found.uncorrected_rms_mm);
}

TEST(ClosedCircle, IsWiderWithoutTheEffect) {
  const Scenario scenario = lacking_puma(true);
  const DataSet data = simulate(scenario);
  const CalibrateResult result = calibrate_in_memory(data, short_looping_job());
  const Found with = measured_again(scenario, data, result.model.robot);
  const Found without = measured_again(scenario, data, result.before);
  EXPECT_LT(with.found_rms_mm, 0.8 * without.found_rms_mm);
}

}  // namespace
}  // namespace demecal
