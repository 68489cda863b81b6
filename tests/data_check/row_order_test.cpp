// Rows of a path are said to be shifted only where they are, however much the arm itself errs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "data_check/check_data.hpp"
#include "kinematics/forward.hpp"
#include "mistaken_case.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr int kPoses = 150;

/// A path of 150 poses of an arm whose links, gears and (as it goes on) zeros are off by `wrong` and its parts, rad and
/// a third of that in m.
DataSet path_of_wrong_arm(const Robot& arm, double wrong, std::uint64_t seed) {
  DataSet data;
  data.robot = arm;
  RandomStream random{seed};
  Chain truth = arm.chain;
  for (Joint& joint : truth.joints) {
    joint.theta_rad += wrong * random.normal();
    joint.a_m += 0.3 * wrong * random.normal();
    joint.alpha_rad += wrong * random.normal();
    joint.d_m += 0.3 * wrong * random.normal();
  }
  std::vector<double> phases;
  for (int joint = 0; joint < arm.chain.size(); ++joint) phases.push_back(random.real(0.0, 6.0));
  for (int i = 0; i < kPoses; ++i) {
    MeasuredPose pose;
    pose.joints.resize(arm.chain.size());
    for (int joint = 0; joint < arm.chain.size(); ++joint)
      pose.joints[joint] =
          (1.0 + 0.2 * joint) * std::sin(0.1 * i * (0.9 + 0.3 * joint) + phases[static_cast<std::size_t>(joint)]);
    JointVector real = pose.joints;
    for (int joint = 0; joint < arm.chain.size(); ++joint)
      real[joint] += wrong * (0.3 * std::sin(3.0 * real[joint] + joint) + static_cast<double>(i) / kPoses);
    pose.position_m =
        tool_position(truth, real) + 3e-5 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(pose);
  }
  return data;
}

TEST(RowOrder, OfAnArmThatErrsAlongAPathIsNotBlamed) {
  for (const Robot& arm : bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const DataCheck check = check_data(path_of_wrong_arm(arm, 5e-3, seed));
      EXPECT_FALSE(check.has(FindingKind::rows_shifted))
          << arm.name << " " << seed << ": " << check.findings.front().sentence;
    }
  }
}

TEST(RowOrder, OfTheSamePathsIsNamedWhereItIsWrong) {
  for (const Robot& arm : bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")) {
    const DataSet right = path_of_wrong_arm(arm, 1e-3, 1);
    for (const int shift : {1, -2}) {
      DataSet data = right;
      for (int i = 90; i < kPoses - 2; ++i)
        data.poses[static_cast<std::size_t>(i)].position_m =
            right.poses[static_cast<std::size_t>(i - shift)].position_m;
      EXPECT_TRUE(check_data(data).has(FindingKind::rows_shifted)) << arm.name << " " << shift;
    }
  }
}

}  // namespace
}  // namespace demecal
