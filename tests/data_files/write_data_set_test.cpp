// What is written loads back to the same values.
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../config/temporary_folder.hpp"
#include "random/random_stream.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

constexpr double kLastBits = 4.0 * std::numeric_limits<double>::epsilon();

void expect_same(double back, double value) {
  EXPECT_LE(std::abs(back - value), kLastBits * std::abs(value));
}

template <typename Vector>
void expect_same_vector(const Vector& back, const Vector& value) {
  ASSERT_EQ(back.size(), value.size());
  for (Eigen::Index i = 0; i < value.size(); ++i) expect_same(back[i], value[i]);
}

Robot random_robot(RandomStream& random) {
  Robot robot;
  robot.name = "arm: \"nine\" #" + std::to_string(random.index(100));
  robot.chain.convention = random.chance(0.5) ? Convention::standard_dh : Convention::modified_dh;
  const std::size_t joints = 1 + random.index(kMaxJoints);
  for (std::size_t i = 0; i < joints; ++i) {
    robot.chain.joints.push_back({.type = random.chance(0.7) ? JointType::revolute : JointType::prismatic,
                                  .theta_rad = random.real(-0.9, 0.9),
                                  .d_m = random.real(-1.0, 1.0),
                                  .a_m = random.real(0.1, 1.0),
                                  .alpha_rad = random.real(-0.9, 0.9),
                                  .beta_rad = random.chance(0.3) ? random.real(-1e-3, 1e-3) : 0.0,
                                  .lower = random.real(-3.0, -1.0),
                                  .upper = random.real(1.0, 3.0)});
    if (is_revolute(robot.chain.joints.back()) && random.chance(0.3))
      robot.chain.joints.back().gear = Gear{static_cast<GearKind>(random.index(4)), random.real(2.0, 200.0)};
    robot.masses.push_back({random.real(0.0, 20.0), {random.real(), random.real(), random.real()}});
  }
  robot.chain.tool_m = {random.real(), random.real(), random.real()};
  robot.gravity_mps2 = {random.real(), random.real(), -9.5};
  robot.repeatability_m = random.real(0.0, 1e-3);
  robot.payload_kg = random.real(1.0, 2000.0);
  if (random.chance(0.5)) {
    robot.home = JointVector::Zero(robot.chain.size());
    for (double& value : robot.home) value = random.real(-1.0, 1.0);
  }
  for (std::size_t i = 0; i < joints && random.chance(0.9); ++i) robot.pulses_per_deg.push_back(random.real(500, 2000));
  if (robot.pulses_per_deg.size() < joints) robot.pulses_per_deg.clear();
  if (is_revolute(robot.chain, 0) && random.chance(0.5)) {
    robot.balancers.push_back({0, random.real(0.1, 0.2), random.real(0.3, 0.5), random.real(-2.0, 2.0)});
  }
  return robot;
}

MeasuredPose random_pose(const DataSet& data, std::size_t index, RandomStream& random) {
  MeasuredPose pose;
  const int joints = data.robot.chain.size();
  pose.joints.resize(joints);
  pose.approach = ApproachSigns(joints);
  for (int i = 0; i < joints; ++i) {
    pose.joints[i] = random.real(-1.0, 1.0);
    (*pose.approach)[i] = static_cast<double>(random.index(3)) - 1.0;
  }
  pose.position_m = {random.real(), random.real(), random.real()};
  pose.orientation =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
  pose.distances_m = {random.real(0.1, 2.0), random.real(0.1, 2.0)};
  pose.torque = JointVector(joints);
  for (double& torque : *pose.torque) torque = random.real(-200.0, 200.0);
  pose.payload_kg = random.real(0.0, 5.0);
  pose.temperature_celsius = random.real(15.0, 30.0);
  pose.time_s = 20.0 * static_cast<double>(index);
  pose.set = static_cast<PoseSet>(random.index(3));
  pose.pose_id = "P, \"" + std::to_string(index) + "\"";
  pose.target = random.chance(0.5) ? "left ear" : "";
  return pose;
}

DataSet random_data_set(RandomStream& random) {
  DataSet data;
  data.name = "no";
  data.robot = random_robot(random);
  data.frame = random.chance(0.5) ? Frame::base : Frame::sensor;
  data.tools_m["left ear"] = {random.real(), random.real(), random.real()};
  data.anchors_m = {{random.real(), random.real(), random.real()}, {0.0, 0.0, 1.0}};
  for (std::size_t i = 0; i < 12; ++i) data.poses.push_back(random_pose(data, i, random));
  return data;
}

void expect_same_robot(const Robot& back, const Robot& robot) {
  EXPECT_EQ(back.name, robot.name);
  EXPECT_EQ(back.chain.convention, robot.chain.convention);
  ASSERT_EQ(back.chain.size(), robot.chain.size());
  for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
    const Joint &read = back.chain.joints[i], &written = robot.chain.joints[i];
    EXPECT_EQ(read.type, written.type);
    expect_same(read.theta_rad, written.theta_rad);
    expect_same(read.d_m, written.d_m);
    expect_same(read.a_m, written.a_m);
    expect_same(read.alpha_rad, written.alpha_rad);
    expect_same(read.beta_rad, written.beta_rad);
    expect_same(read.lower, written.lower);
    expect_same(read.upper, written.upper);
    EXPECT_EQ(read.gear, written.gear);
    EXPECT_EQ(back.masses[i].mass_kg, robot.masses[i].mass_kg);
    expect_same_vector(back.masses[i].centre_m, robot.masses[i].centre_m);
  }
  expect_same_vector(back.chain.tool_m, robot.chain.tool_m);
  EXPECT_EQ(back.gravity_mps2, robot.gravity_mps2);
  expect_same(*back.repeatability_m, *robot.repeatability_m);
  expect_same(*back.payload_kg, *robot.payload_kg);
  EXPECT_EQ(back.pulses_per_deg, robot.pulses_per_deg);
  ASSERT_EQ(back.balancers.size(), robot.balancers.size());
  for (std::size_t i = 0; i < robot.balancers.size(); ++i) {
    EXPECT_EQ(back.balancers[i].joint, robot.balancers[i].joint);
    expect_same(back.balancers[i].fixed_m, robot.balancers[i].fixed_m);
    expect_same(back.balancers[i].moving_m, robot.balancers[i].moving_m);
    expect_same(back.balancers[i].shortest_rad, robot.balancers[i].shortest_rad);
  }
  ASSERT_EQ(back.home.size(), robot.home.size());
  if (robot.home.size() > 0) expect_same_vector(back.home, robot.home);
}

void expect_same_pose(const MeasuredPose& back, const MeasuredPose& pose) {
  expect_same_vector(back.joints, pose.joints);
  expect_same_vector(*back.position_m, *pose.position_m);
  EXPECT_LE(back.orientation->angularDistance(*pose.orientation), 1e-7);
  EXPECT_LE((back.orientation->coeffs() - pose.orientation->coeffs()).norm(), 1e-15);
  ASSERT_EQ(back.distances_m.size(), pose.distances_m.size());
  expect_same(back.distances_m[1], pose.distances_m[1]);
  EXPECT_EQ(*back.approach, *pose.approach);
  EXPECT_EQ(*back.torque, *pose.torque);
  EXPECT_EQ(back.payload_kg, pose.payload_kg);
  EXPECT_EQ(back.temperature_celsius, pose.temperature_celsius);
  EXPECT_EQ(back.time_s, pose.time_s);
  EXPECT_EQ(back.set, pose.set);
  EXPECT_EQ(back.pose_id, pose.pose_id);
  EXPECT_EQ(back.target, pose.target);
}

TEST(WriteRobot, LoadsBackToTheSameArm) {
  const TemporaryFolder folder;
  RandomStream random{761, 1};
  for (int trial = 0; trial < 30; ++trial) {
    const Robot robot = random_robot(random);
    write_robot(robot, folder.path() / "robot.yaml", "an arm\nof two lines");
    expect_same_robot(load_robot(folder.path() / "robot.yaml"), robot);
  }
}

TEST(WriteDataSet, LoadsBackToTheSamePoses) {
  const TemporaryFolder folder;
  RandomStream random{761, 2};
  for (int trial = 0; trial < 20; ++trial) {
    const DataSet data = random_data_set(random);
    const DataSet back = load_data_set(write_data_set(data, folder.path() / "set", "random poses"));
    EXPECT_EQ(back.name, data.name);
    EXPECT_EQ(back.frame, data.frame);
    expect_same_robot(back.robot, data.robot);
    expect_same_vector(back.tools_m.at("left ear"), data.tools_m.at("left ear"));
    ASSERT_EQ(back.anchors_m.size(), 2u);
    expect_same_vector(back.anchors_m[0], data.anchors_m[0]);
    ASSERT_EQ(back.poses.size(), data.poses.size());
    for (std::size_t i = 0; i < data.poses.size(); ++i) expect_same_pose(back.poses[i], data.poses[i]);
  }
}

TEST(WriteDataSet, WritesEveryKeyThatColumnsHave) {
  const TemporaryFolder folder;
  RandomStream random{761, 4};
  DataSet data = random_data_set(random);
  for (MeasuredPose& pose : data.poses) {
    pose.position_covariance_m2 = Eigen::Matrix3d::Identity() * 1e-9;
    pose.contact = "socket";
  }
  const YamlNode written = read_yaml(write_data_set(data, folder.path(), "everything"));
  ColumnMap::for_each_key(
      [&](std::string_view key, auto) { EXPECT_NE(written.at("columns").find(std::string(key)), nullptr) << key; });
}

TEST(WriteDataSet, LeavesOutWhatWasNotMeasured) {
  const TemporaryFolder folder;
  RandomStream random{761, 3};
  DataSet data = random_data_set(random);
  data.anchors_m.clear();
  data.tools_m.clear();
  for (MeasuredPose& pose : data.poses) {
    MeasuredPose bare;
    bare.joints = pose.joints;
    bare.position_m = pose.position_m;
    bare.pose_id = pose.pose_id;
    pose = bare;
  }
  const DataSet back = load_data_set(write_data_set(data, folder.path(), "bare poses"));
  const MeasuredPose& pose = back.poses.front();
  EXPECT_FALSE(pose.orientation || pose.approach || pose.payload_kg || pose.temperature_celsius || pose.time_s);
  EXPECT_TRUE(pose.distances_m.empty());
  EXPECT_TRUE(back.anchors_m.empty() && back.tools_m.empty());
}

}  // namespace
}  // namespace demecal
