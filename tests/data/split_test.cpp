// Dividing poses into sets at random, and choosing them by set.
#include "data/data_set.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace demecal {
namespace {

DrawIndex draws(std::uint64_t seed) {
  return [bits = std::mt19937_64(seed)](std::size_t n) mutable { return static_cast<std::size_t>(bits() % n); };
}

/// `ids` poses of three repeats each, the repeats far apart.
DataSet repeated_poses(int ids) {
  DataSet data;
  for (int row = 0; row < 3 * ids; ++row) {
    MeasuredPose pose;
    pose.pose_id = std::to_string(row % ids);
    data.poses.push_back(pose);
  }
  return data;
}

TEST(Split, KeepsRepeatsTogether) {
  DataSet data = repeated_poses(40);
  split_by_pose(data.poses, {.validation = 0.3, .accept = 0.2}, draws(1));
  std::map<std::string, std::set<PoseSet>> sets;
  for (const MeasuredPose& pose : data.poses) sets[pose.pose_id].insert(pose.set);
  for (const auto& [id, of_id] : sets) EXPECT_EQ(of_id.size(), 1u) << id;
}

TEST(Split, GivesEachSetItsShareOfThePoses) {
  DataSet data = repeated_poses(40);
  split_by_pose(data.poses, {.validation = 0.3, .accept = 0.2}, draws(1));
  EXPECT_EQ(poses_of(data, PoseSet::validation).size(), 3u * 12u);
  EXPECT_EQ(poses_of(data, PoseSet::accept).size(), 3u * 8u);
  EXPECT_EQ(poses_of(data, PoseSet::calibration).size(), 3u * 20u);
}

TEST(Split, IsAFunctionOfTheDraws) {
  DataSet first = repeated_poses(40), again = repeated_poses(40), other = repeated_poses(40);
  split_by_pose(first.poses, {}, draws(7));
  split_by_pose(again.poses, {}, draws(7));
  split_by_pose(other.poses, {}, draws(8));
  EXPECT_EQ(poses_of(first, PoseSet::validation), poses_of(again, PoseSet::validation));
  EXPECT_NE(poses_of(first, PoseSet::validation), poses_of(other, PoseSet::validation));
}

TEST(Split, LeavesCalibrationAPose) {
  DataSet data = repeated_poses(2);
  split_by_pose(data.poses, {.validation = 1.0, .accept = 1.0}, draws(1));
  EXPECT_EQ(poses_of(data, PoseSet::calibration).size(), 3u);
  EXPECT_EQ(poses_of(data, PoseSet::validation).size(), 3u);
}

TEST(DataSet, KnowsTheToolOfEveryTarget) {
  DataSet data;
  data.robot.chain.tool_m = {1.0, 2.0, 3.0};
  data.tools_m["A"] = {4.0, 5.0, 6.0};
  MeasuredPose pose;
  EXPECT_EQ(nominal_tool(data, pose), Eigen::Vector3d(1.0, 2.0, 3.0));
  pose.target = std::string("A");
  EXPECT_EQ(nominal_tool(data, pose), Eigen::Vector3d(4.0, 5.0, 6.0));
}

}  // namespace
}  // namespace demecal
