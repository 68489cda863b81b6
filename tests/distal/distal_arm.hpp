// An arm several of whose joints err, measured in each of the ways that distal learning learns from.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "calibration/erring_arm.hpp"
#include "calibration/job.hpp"

namespace demecal {

inline const std::vector<std::string> kDistalErrors{
    "0.002 * SIN(theta)", "0.003 * COS(theta)", "-0.002 * SIN(theta)", "", "0.002 * theta", ""};

enum class Measured { position, pose, distances };

inline DataSet measured(Measured what, std::uint64_t seed) {
  DataSet data = measure(true_puma(kDistalErrors), 45, 2e-5, seed, what == Measured::pose);
  if (what != Measured::distances) return data;
  data.anchors_m = {{2.0, 0.3, 0.1}, {-0.5, 1.8, 0.4}};
  for (MeasuredPose& pose : data.poses) {
    for (const Eigen::Vector3d& anchor : data.anchors_m) pose.distances_m.push_back((*pose.position_m - anchor).norm());
    pose.position_m.reset();
  }
  return data;
}

inline Job distal_job() {
  Job job;
  job.method = Method::distal;
  job.seed = 4;
  job.declared = {.joint_corrections = true};
  job.gp.population_size = 60;
  job.gp.number_generations = 40;
  job.distal.rounds = 4;
  return job;
}

/// The PUMA with random smooth corrections of a size.
inline CorrectedRobot corrected_puma(double size_rad, RandomStream& random) {
  CorrectedRobot robot = true_puma(std::vector<std::string>(6));
  for (JointCorrection& correction : robot.corrections) {
    const Tree wave =
        apply(Primitive::sine, apply(Primitive::add, variable_tree(0), constant_tree(random.real(-3, 3))));
    correction = JointCorrection(apply(Primitive::multiply, constant_tree(size_rad), wave), {}, {-M_PI, M_PI});
  }
  return robot;
}

inline std::string word_of_measured(const testing::TestParamInfo<Measured>& info) {
  constexpr const char* kWords[] = {"Position", "FullPose", "Distances"};
  return kWords[static_cast<std::size_t>(info.param)];
}

}  // namespace demecal
