// The circle on simulated robots: what the model predicts after correction is what is found when measured again.
#include <gtest/gtest.h>

#include <cmath>

#include "config/scenario_file.hpp"
#include "prediction/measurement.hpp"
#include "simulation/simulated_robot.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

Scenario demo_scenario() {
  return load_scenario(DEMECAL_SOURCE_DIR "/configs/scenarios/demo.yaml");
}

Job short_job(const DeclaredModel& declared) {
  Job job;
  job.name = "circle";
  job.seed = 11;
  job.declared = declared;
  job.gp.number_generations = 60;
  job.closed_loop.max_effects = 0;
  return job;
}

struct Circle {
  double predicted_rms_mm = 0.0;  ///< the model's error on poses that it was neither fitted to nor chosen on
  double found_rms_mm = 0.0;  ///< distance between where a corrected robot was asked to be and where it was measured
  double uncorrected_rms_mm = 0.0;
};

/// Sends the robot to the accept poses again, corrected, and measures.
Circle close_circle(const Scenario& scenario, const DataSet& data, const CorrectedRobot& model) {
  const SimulatedRobot real(scenario);
  RandomStream random{scenario.seed, 99};
  Circle circle;
  double found = 0.0, uncorrected = 0.0;
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  for (const std::size_t index : accept) {
    const MeasuredPose& pose = data.poses[index];
    const Eigen::Isometry3d goal =
        model.sensor_from_base * forward(data.robot.chain, pose.joints) * model.tool(pose.target);
    const InverseSolution command = corrected_command(model, data.robot.chain, pose.joints);
    EXPECT_EQ(command.status, InverseStatus::converged);
    EXPECT_LT((model.predict(command.q, pose.target).translation() - goal.translation()).norm(), 1e-8);
    const MeasuredPose again = real.measure(command.q, *pose.approach, 0.0, random);
    found += (*again.position_m - goal.translation()).squaredNorm();
    uncorrected += (*pose.position_m - goal.translation()).squaredNorm();
  }
  const double n = static_cast<double>(accept.size());
  circle.predicted_rms_mm = error_figures(model, data, accept).rms_mm;
  circle.found_rms_mm = 1e3 * std::sqrt(found / n);
  circle.uncorrected_rms_mm = 1e3 * std::sqrt(uncorrected / n);
  return circle;
}

TEST(Circle, ClosesWithEvolvedJointCorrections) {
  const Scenario scenario = demo_scenario();
  const DataSet data = simulate(scenario);
  const CalibrateResult result =
      calibrate_in_memory(data, short_job({.registration = true, .joint_corrections = true}));
  const Circle circle = close_circle(scenario, data, result.model.robot);
  EXPECT_NEAR(circle.found_rms_mm, circle.predicted_rms_mm, 0.2 * circle.predicted_rms_mm);
  EXPECT_LT(circle.found_rms_mm, 0.6 * circle.uncorrected_rms_mm);
}

TEST(Circle, ClosesToTheNoiseWhereTheModelHoldsAllThatIsWrong) {
  Scenario scenario = demo_scenario();
  scenario.joint_errors.clear();
  scenario.backlash.clear();
  scenario.geometry = {
      {1, LinkParameter::a, 0.0015}, {2, LinkParameter::theta, 0.002}, {3, LinkParameter::alpha, -0.001}};
  scenario.poses = {60, 20, 40};
  const DataSet data = simulate(scenario);
  const CalibrateResult result =
      calibrate_in_memory(data, short_job({.registration = true, .joint_offset = true, .geometry = true}));
  const Circle circle = close_circle(scenario, data, result.model.robot);
  const double noise_mm = 1e3 * scenario.noise_m * std::sqrt(3.0);
  EXPECT_LT(circle.found_rms_mm, 1.5 * noise_mm);
  EXPECT_LT(circle.predicted_rms_mm, 1.5 * noise_mm);
  EXPECT_GT(circle.uncorrected_rms_mm, 5.0 * noise_mm);
}

TEST(KnownRobot, CorrectionsOfACleanArmStayNeutral) {
  Scenario scenario = demo_scenario();
  scenario.joint_errors.clear();
  scenario.backlash.clear();
  int kept = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    scenario.seed = seed;
    const DataSet data = simulate(scenario);
    const CalibrateResult result =
        calibrate_in_memory(data, short_job({.registration = true, .joint_corrections = true}));
    for (const JointSummary& joint : result.model.joints) kept += joint.kept ? 1 : 0;
  }
  EXPECT_LE(kept, 1) << "of 30 joints";
}

}  // namespace
}  // namespace demecal
