// An arm with smooth joint errors and with backlash that no job declares, measured with its approaches recorded.
#pragma once

#include "calibration/erring_arm.hpp"
#include "calibration/job.hpp"

namespace demecal {

inline Effect backlash_of_joint_2(double width_rad) {
  return {.kind = "backlash", .joint = 1, .values = {width_rad}};
}

/// 120 poses with 0.05 mm noise per axis, a third of them for validation.
inline DataSet lacking_arm(double backlash_rad, std::uint64_t seed) {
  CorrectedRobot truth = true_puma({"0.0008*SIN(theta)", "", "0.0006*COS(theta)", "", "", ""});
  truth.described.chain = truth.chain;
  truth.effects = {backlash_of_joint_2(backlash_rad)};
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 120, 0.0, seed, false);
  RandomStream random{seed, 815};
  for (MeasuredPose& pose : data.poses) {
    pose.approach = ApproachSigns(6);
    for (double& sign : *pose.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = truth.predict(Stop(pose), "").translation() + 5e-5 * noise;
  }
  return data;
}

inline Job looping_job() {
  Job job;
  job.declared = {.registration = true, .joint_corrections = true};
  job.closed_loop.candidates = {"backlash", "gain", "coupling"};
  return job;
}

}  // namespace demecal
