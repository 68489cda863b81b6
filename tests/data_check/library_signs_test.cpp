// A joint of a common arm that counts the other way: it is named first, and no other reading that makes up for it by
// turning the base.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "data_check/pendant.hpp"
#include "data_files/robot_file.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// What a controller shows whose `joint` counts the other way, to a hundredth of a millimetre.
DataSet shown_by_other_sign(const Robot& robot, Eigen::Index joint, std::uint64_t seed) {
  RandomStream stream{seed};
  DataSet data;
  data.robot = robot;
  data.frame = Frame::base;
  data.file = "pendant.csv";
  for (int i = 0; i < 12; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, robot.chain);
    const Eigen::Vector3d point = forward(robot.chain, pose.joints) * robot.chain.tool_m;
    pose.position_m = point.unaryExpr([](double value) { return 1e-5 * std::round(value / 1e-5); });
    pose.joints[joint] *= -1.0;
    pose.pose_id = std::to_string(i + 1);
    data.poses.push_back(std::move(pose));
  }
  return data;
}

TEST(LibrarySigns, AreNamedWithoutReadingsThatTurnTheBase) {
  const std::filesystem::path library = std::filesystem::path(DEMECAL_SOURCE_DIR) / "configs/robots";
  for (const char* arm : {"ur5", "kuka-kr6-r900-2", "kuka-iiwa14"}) {
    for (const Eigen::Index joint : {0, 1, 3, 5}) {
      for (const Eigen::Vector3d& tool_m : {Eigen::Vector3d(0.04, 0.01, 0.12), Eigen::Vector3d(0.0, 0.0, 0.0)}) {
        SCOPED_TRACE(std::string(arm) + ", joint " + std::to_string(joint + 1));
        Robot robot = load_robot(library / (std::string(arm) + ".yaml"));
        if (tool_m.isZero() && joint + 1 == robot.chain.size()) continue;  // its sign moves no point
        robot.chain.tool_m = tool_m;
        const PendantComparison comparison = compare_with_pendant(shown_by_other_sign(robot, joint, 3310));
        EXPECT_TRUE(comparison.explained);
        ASSERT_FALSE(comparison.findings.empty());
        EXPECT_EQ(comparison.findings.front(),
                  "It fits if joint " + std::to_string(joint + 1) + " is taken with the other sign.");
        // With the tool on the last axis joint 6 of the iiwa has equals: half a turn of joint 5, and joints 2 and 4
        // with half a turn of joint 1.
        using namespace ::testing;
        for (std::size_t i = 1; i < comparison.findings.size(); ++i)
          EXPECT_THAT(comparison.findings[i], AnyOf(EndsWith("it fits if +180 deg are added to joint 5."),
                                                    AllOf(StartsWith("Fits alike: "), HasSubstr("stand 0.0 mm from"))));
      }
    }
  }
}

}  // namespace
}  // namespace demecal
