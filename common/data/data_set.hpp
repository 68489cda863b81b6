// What was measured: the poses of one robot, the points they were measured at, and where they came from.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "data/pose.hpp"

namespace demecal {

/// Whether positions are given in the robot's base frame or in the instrument's own.
enum class Frame { base, sensor };

/// Per link, for gravity: mass and centre of mass in the link's own frame.
struct LinkMass {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
};

/// The arm as its maker describes it.
struct Robot {
  std::string name;
  Chain chain;
  std::vector<LinkMass> masses;  ///< empty where unknown
  Eigen::Vector3d gravity_mps2{0.0, 0.0, -9.81};
  std::optional<double> repeatability_m;
  JointVector home{};  ///< rad, m: where programs start that do not say it; empty: not declared
};

struct DataSet {
  std::string name;
  Robot robot;
  Frame frame = Frame::sensor;
  std::vector<MeasuredPose> poses;
  std::vector<MeasuredPose> excluded;              ///< by name: no part of anything but the report's list of them
  std::map<std::string, Eigen::Vector3d> tools_m;  ///< nominal tool point of each target; empty: the robot's tool
  std::vector<Eigen::Vector3d> anchors_m;          ///< known fixed points of the distances
  bool anchors_unknown = false;
  std::string file;    ///< of the poses, as named to the user
  std::string sha256;  ///< of the bytes the poses were read from
};

/// Indices into poses, in their order.
std::vector<std::size_t> poses_of(const DataSet& data, PoseSet set);

/// The nominal tool point of a pose, in the flange frame, m.
Eigen::Vector3d nominal_tool(const DataSet& data, const MeasuredPose& pose);

}  // namespace demecal
