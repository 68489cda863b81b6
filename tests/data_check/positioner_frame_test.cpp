// Positions that an instrument beside the arm saw, of a robot whose positions count from the workpiece: it is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "data_check/check_data.hpp"
#include "data_files/robot_file.hpp"
#include "kinematics/forward.hpp"
#include "random/random_stream.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

constexpr const char* kBesideTable = R"yaml(name: an arm before a table
convention: urdf
joints:
  - {name: A1, type: revolute, xyz_mm: [0, 0, 400], axis: [0, 0, 1], limits_deg: [-60, 60]}
  - {name: A2, type: revolute, xyz_mm: [50, 0, 0], axis: [0, 1, 0], limits_deg: [-60, 40]}
  - {name: A3, type: revolute, xyz_mm: [0, 0, 500], axis: [0, 1, 0], limits_deg: [-40, 80]}
  - {name: A4, type: revolute, xyz_mm: [200, 0, 40], axis: [1, 0, 0], limits_deg: [-150, 150]}
  - {name: A5, type: revolute, xyz_mm: [300, 0, 0], axis: [0, 1, 0], limits_deg: [-100, 100]}
  - {name: A6, type: revolute, xyz_mm: [80, 0, 0], axis: [1, 0, 0], limits_deg: [-170, 170]}
tool_mm: [60, 20, 120]
)yaml";

constexpr const char* kTiltAndTurn = R"yaml(positioner:
  - {name: tilt, type: revolute, xyz_mm: [1200, 0, 600], axis: [0, 1, 0], limits_deg: [-70, 70]}
  - {name: turn, type: revolute, xyz_mm: [0, 0, 150], axis: [0, 0, 1], limits_deg: [-170, 170]}
)yaml";

/// Seen from the workpiece, or from beside the arm; in the arm's base frame, or an instrument's.
DataSet seen(bool from_workpiece, Frame frame) {
  const Robot alone = read_robot(parse_yaml(kBesideTable, "robot.yaml"));
  RandomStream stream{4711};
  DataSet data;
  data.robot = read_robot(parse_yaml(std::string(kBesideTable) + kTiltAndTurn, "robot.yaml"));
  data.frame = frame;
  Eigen::Isometry3d sensor = Eigen::Isometry3d::Identity();
  if (frame == Frame::sensor)
    sensor = Eigen::Translation3d(1.0, -2.0, 0.3) * Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.1, 0.0, 1.0).normalized());
  for (int i = 0; i < 60; ++i) {
    MeasuredPose pose;
    pose.joints.resize(8);
    for (int joint = 0; joint < 8; ++joint) {
      const Joint& row = data.robot.chain.joints[static_cast<std::size_t>(joint)];
      pose.joints[joint] = stream.real(row.lower, row.upper);
    }
    const Eigen::Isometry3d flange = from_workpiece ? forward(data.robot.chain, pose.joints)
                                                    : forward(alone.chain, JointVector(pose.joints.tail(6)));
    pose.position_m = sensor * (flange * alone.chain.tool_m);
    for (double& value : *pose.position_m) value += stream.normal() * 5e-5;
    pose.pose_id = std::to_string(i + 1);
    pose.line = static_cast<std::size_t>(i) + 2;
    data.poses.push_back(std::move(pose));
  }
  return data;
}

TEST(PositionerFrame, OfAnArmsBaseIsNamedInPlaceOfAnotherRobot) {
  for (const Frame frame : {Frame::base, Frame::sensor}) {
    EXPECT_NE(check_data(seen(true, frame)).verdict(), DataVerdict::contradiction);
    const DataCheck check = check_data(seen(false, frame));
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
    ASSERT_FALSE(check.findings.empty());
    EXPECT_THAT(check.findings.back().sentence,
                ::testing::AllOf(::testing::HasSubstr("do not move with the positioner (joints 1 to 2 left out)"),
                                 ::testing::HasSubstr("without `positioner:`")));
  }
}

}  // namespace
}  // namespace demecal
