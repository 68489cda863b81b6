// A joint's zero that changes during the measurement is named as that; moves of the instrument and drift are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

std::string told(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

TEST(ZeroJump, IsNamedWithItsJointRowAndSize) {
  for (const std::uint64_t seed : {1, 2}) {
    for (const DataSet& right : long_measurements(seed)) {
      for (const int joint : {1, 2}) {
        DataSet data = right;
        const std::size_t from = 3 * data.poses.size() / 5;
        for (std::size_t i = from; i < data.poses.size(); ++i) data.poses[i].joints[joint] += radians(0.2);
        const DataCheck check = check_data(data);
        const std::string of = data.robot.name + ", joint " + std::to_string(joint + 1) + ":\n" + told(check);
        ASSERT_FALSE(check.findings.empty()) << of;
        const Finding& finding = check.findings.front();
        EXPECT_EQ(finding.kind, FindingKind::joint_zero_changed) << of;
        EXPECT_EQ(finding.joint, joint) << of;
        EXPECT_NEAR(static_cast<double>(finding.poses.size()), static_cast<double>(data.poses.size() - from), 2.0)
            << of;
        EXPECT_EQ(check.verdict(), DataVerdict::suspicious) << of;
      }
    }
  }
}

TEST(ZeroJump, AMoveOfTheInstrumentIsNone) {
  for (const DataSet& right : long_measurements(3)) {
    DataSet data = right;
    const Eigen::Isometry3d move(Eigen::Translation3d(1e-3, -2e-3, 5e-4) *
                                 Eigen::AngleAxisd(1e-3, Eigen::Vector3d(1, 2, -1).normalized()));
    for (std::size_t i = data.poses.size() / 2; i < data.poses.size(); ++i)
      data.poses[i].position_m = move * *data.poses[i].position_m;
    const DataCheck check = check_data(data);
    EXPECT_FALSE(check.has(FindingKind::joint_zero_changed)) << data.robot.name << told(check);
    EXPECT_TRUE(check.has(FindingKind::instrument_moved)) << data.robot.name << told(check);
  }
}

TEST(ZeroJump, DriftOfAJointIsNone) {
  for (const DataSet& right : long_measurements(4)) {
    for (const double settling : {0.1, 0.3, 1e3}) {
      DataSet data = right;
      const auto n = static_cast<double>(data.poses.size());
      const double whole = -std::expm1(-1.0 / settling);
      for (std::size_t i = 0; i < data.poses.size(); ++i)
        data.poses[i].joints[1] += radians(0.05) * -std::expm1(-static_cast<double>(i) / n / settling) / whole;
      EXPECT_FALSE(check_data(data).has(FindingKind::joint_zero_changed)) << data.robot.name << " " << settling;
    }
  }
}

/// The poses of the first half, and the same once more.
DataSet measured_twice(const DataSet& right) {
  DataSet twice = right;
  const std::size_t half = right.poses.size() / 2;
  twice.poses.resize(2 * half);
  RandomStream random({5});
  for (std::size_t i = half; i < twice.poses.size(); ++i) {
    twice.poses[i] = right.poses[i - half];
    twice.poses[i].line = right.poses[i].line;
    twice.poses[i].pose_id = right.poses[i].pose_id;
    for (double& coordinate : *twice.poses[i].position_m) coordinate += 3e-5 * random.normal();
  }
  return twice;
}

TEST(ZeroJump, WhatChangesWithTheSideOfApproachOrThePayloadIsNone) {
  for (const DataSet& right : long_measurements(15)) {
    const DataSet twice = measured_twice(right);
    const std::size_t half = twice.poses.size() / 2;
    for (const bool by_side : {true, false}) {
      DataSet data = twice;
      for (std::size_t i = 0; i < data.poses.size(); ++i) {
        MeasuredPose& pose = data.poses[i];
        const double side = i < half ? 1.0 : -1.0;
        if (by_side) pose.approach = ApproachSigns::Constant(pose.joints.size(), side);
        if (!by_side) pose.payload_kg = i < half ? 10.0 : 0.0;
        pose.joints[1] += 4e-4 * side;
        pose.joints[2] += 4e-4 * side;
      }
      const DataCheck check = check_data(data);
      const std::string of = data.robot.name + (by_side ? ", sides\n" : ", payload\n") + told(check);
      EXPECT_FALSE(check.has(FindingKind::joint_zero_changed)) << of;
      EXPECT_FALSE(check.has(FindingKind::instrument_moved)) << of;
      DataSet jumped = data;
      for (std::size_t i = 3 * half / 2; i < jumped.poses.size(); ++i) jumped.poses[i].joints[1] += radians(0.2);
      EXPECT_TRUE(check_data(jumped).has(FindingKind::joint_zero_changed)) << of;
    }
  }
}

/// Swept by one joint up and then down, sides not stated.
DataSet swept(DataSet data, int joint) {
  std::ranges::sort(data.poses, {}, [joint](const MeasuredPose& pose) { return pose.joints[joint]; });
  std::vector<MeasuredPose> up, down;
  for (std::size_t i = 0; i < data.poses.size(); ++i) (i % 6 < 3 ? up : down).push_back(data.poses[i]);
  std::ranges::reverse(down);
  up.insert(up.end(), down.begin(), down.end());
  data.poses = std::move(up);
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    data.poses[i].approach.reset();
    data.poses[i].line = i + 2;
  }
  return data;
}

TEST(ZeroJump, IsToldAsLostMotionTooWhereJointsTurnBackThere) {
  const std::string lost_motion = "lost motion of theirs explains it as well";
  for (const DataSet& right : long_measurements(17)) {
    const DataSet given = swept(right, 1);
    DataSet slack = given, jumped = given;
    for (std::size_t i = 0; i < given.poses.size(); ++i) {
      // The first pose behind the turn, of three targets, lies farther up still.
      const bool down = i >= given.poses.size() / 2 + 3, late = i >= 3 * given.poses.size() / 4;
      slack.poses[i].joints[1] += down ? 1e-3 : -1e-3;
      if (late) jumped.poses[i].joints[1] += 2e-3;
    }
    const DataCheck check = check_data(slack), other = check_data(jumped);
    EXPECT_TRUE(check.has(FindingKind::joint_zero_changed)) << right.robot.name << '\n' << told(check);
    EXPECT_THAT(told(check), testing::HasSubstr(lost_motion)) << right.robot.name;
    EXPECT_TRUE(other.has(FindingKind::joint_zero_changed)) << right.robot.name << '\n' << told(other);
    EXPECT_THAT(told(other), testing::Not(testing::HasSubstr(lost_motion))) << right.robot.name;
  }
}

TEST(ZeroJump, WhatIsMoreThanAPayloadDoesIsNamedThoughThePayloadChangesThere) {
  for (const DataSet& right : long_measurements(16)) {
    DataSet data = right;
    for (std::size_t i = 0; i < data.poses.size(); ++i) {
      const bool behind = i >= data.poses.size() / 2;
      data.poses[i].payload_kg = behind ? 2.0 : 0.0;
      if (behind) data.poses[i].joints[1] += radians(0.3);
    }
    EXPECT_TRUE(check_data(data).has(FindingKind::joint_zero_changed)) << data.robot.name << '\n'
                                                                       << told(check_data(data));
  }
}

}  // namespace
}  // namespace demecal
