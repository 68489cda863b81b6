// Arms with random structures after their links, and what is measured of them.
#pragma once

#include "kinematics/angles.hpp"
#include "kinematics/random_arm.hpp"
#include "structure/structured_arm.hpp"

namespace demecal {

inline Eigen::Vector3d random_vector(RandomStream& stream, double largest) {
  return {stream.real(-largest, largest), stream.real(-largest, largest), stream.real(-largest, largest)};
}

inline DataSet data_of(const Chain& chain) {
  DataSet data;
  data.robot.chain = chain;
  data.file = "poses.csv";
  return data;
}

/// The chain in a base turned and shifted at random.
inline CorrectedRobot placed_robot(RandomStream& stream, const Chain& chain) {
  CorrectedRobot robot = nominal_robot(data_of(chain));
  robot.sensor_from_base.linear() = rotation_of(random_vector(stream, 1.0));
  robot.sensor_from_base.translation() = random_vector(stream, 1.0);
  return robot;
}

/// Amounts up to `largest`, rad or m.
inline StructuredArm with_structure(RandomStream& stream, const CorrectedRobot& robot, const Genome& genome,
                                    double largest) {
  StructuredArm arm{robot, genome};
  for (std::size_t i = 0; i < gene_count(genome); ++i) arm.values.push_back(stream.real(-largest, largest));
  return arm;
}

/// Adds `count` poses of one set at random joints, as an instrument with this noise per axis sees them.
inline void measure(DataSet& data, const StructuredArm& truth, RandomStream& stream, PoseSet set, int count,
                    double noise_m) {
  for (int i = 0; i < count; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    const Eigen::Vector3d noise(stream.normal(), stream.normal(), stream.normal());
    pose.position_m = truth.predict(pose.joints, "").translation() + noise_m * noise;
    pose.set = set;
    data.poses.push_back(pose);
  }
}

}  // namespace demecal
