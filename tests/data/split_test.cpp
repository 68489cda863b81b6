// Dividing poses into sets at random, those of every contact by themselves, and choosing them by set.
#include "data/data_set.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

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

/// Poses that touch so many contacts so often each.
DataSet touching_poses(const std::vector<std::size_t>& touches) {
  DataSet data;
  for (std::size_t contact = 0; contact < touches.size(); ++contact)
    for (std::size_t i = 0; i < touches[contact]; ++i) {
      MeasuredPose pose;
      pose.contact = "C" + std::to_string(100 + contact);
      pose.pose_id = pose.contact + "-" + std::to_string(i);
      data.poses.push_back(pose);
    }
  return data;
}

std::map<std::string, std::map<PoseSet, std::size_t>> counts_by_contact(const DataSet& data) {
  std::map<std::string, std::map<PoseSet, std::size_t>> counts;
  for (const MeasuredPose& pose : data.poses) ++counts[pose.contact][pose.set];
  return counts;
}

TEST(Split, DividesThePosesOfEveryContact) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    DataSet data = touching_poses(std::vector<std::size_t>(6, 10));
    split_by_pose(data.poses, {.validation = 0.3, .accept = 0.2}, draws(seed));
    for (auto& [contact, counts] : counts_by_contact(data)) {
      EXPECT_EQ(counts[PoseSet::calibration], 5u) << contact;
      EXPECT_EQ(counts[PoseSet::validation], 3u) << contact;
      EXPECT_EQ(counts[PoseSet::accept], 2u) << contact;
    }
  }
}

TEST(Split, LeavesNoSetASingleTouchOfAContact) {
  for (const std::size_t touches : {2U, 3U, 4U, 5U, 6U, 7U}) {
    DataSet data = touching_poses(std::vector<std::size_t>(20, touches));
    split_by_pose(data.poses, {.validation = 0.3, .accept = 0.1}, draws(7));
    for (const auto& [contact, counts] : counts_by_contact(data)) {
      EXPECT_EQ(counts.size() == 1 || touches > 3, true) << "too few to be divided";
      for (const auto& [set, count] : counts) EXPECT_GE(count, 2u) << contact << " of " << touches;
    }
    const auto all = static_cast<double>(data.poses.size());
    EXPECT_NEAR(static_cast<double>(poses_of(data, PoseSet::validation).size()), 0.3 * all, 2.0) << touches;
    EXPECT_NEAR(static_cast<double>(poses_of(data, PoseSet::accept).size()), 0.1 * all, 2.0) << touches;
  }
}

TEST(Split, LeavesMeasuredPosesAsTheyAreWithoutContacts) {
  DataSet alone = repeated_poses(40), beside = alone;
  for (MeasuredPose touch : touching_poses({8, 8}).poses) beside.poses.push_back(touch);
  split_by_pose(alone.poses, {}, draws(5));
  split_by_pose(beside.poses, {}, draws(5));
  for (std::size_t i = 0; i < alone.poses.size(); ++i) EXPECT_EQ(alone.poses[i].set, beside.poses[i].set);
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
