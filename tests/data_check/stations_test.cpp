// Stations that did not measure one arm are named, with the joint where another zero is all; sound ones are not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "fitting/stations.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// Parts of a measurement, one behind the other, each as a station has it that stood elsewhere; without targets.
std::vector<DataSet> as_stations(const DataSet& whole, std::size_t count, RandomStream& stream) {
  std::vector<DataSet> sets;
  const std::size_t part = whole.poses.size() / count;
  for (std::size_t i = 0; i < count; ++i) {
    DataSet set = whole;
    set.name = std::string(1, static_cast<char>('A' + i));
    set.sha256 = set.name;
    const auto first = whole.poses.begin() + static_cast<std::ptrdiff_t>(i * part);
    set.poses.assign(first, first + static_cast<std::ptrdiff_t>(part));
    const Eigen::AngleAxisd turn(stream.real(-2.0, 2.0), Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d move_m(stream.real(-2.0, 2.0), stream.real(-2.0, 2.0), stream.real(-0.5, 0.5));
    for (MeasuredPose& pose : set.poses) {
      pose.position_m = turn * *pose.position_m + move_m;
      pose.set = PoseSet::calibration;
      pose.time_s.reset();
    }
    set.frame = Frame::sensor;
    sets.push_back(std::move(set));
  }
  return sets;
}

std::string station_sentences(const std::vector<Finding>& findings) {
  std::string all;
  for (const Finding& finding : findings) all += finding.sentence + "\n";
  return all;
}

TEST(StationsOfOneArm, AreFoundSound) {
  for (const std::uint64_t seed : {71U, 72U, 73U, 74U, 75U}) {
    RandomStream stream{seed};
    for (const DataSet& whole : long_measurements(seed)) {
      for (const std::size_t count : {2U, 3U}) {
        const auto findings = check_stations(joined_stations(as_stations(whole, count, stream), StationTools::own));
        EXPECT_TRUE(findings.empty()) << whole.robot.name << ", seed " << seed << ": " << station_sentences(findings);
      }
    }
  }
}

TEST(StationsOfOneArm, WithAnotherZeroAreNamedWithJointAndSize) {
  constexpr double kBy_rad = 2e-3;
  for (const std::uint64_t seed : {76U, 77U}) {
    RandomStream stream{seed};
    for (const DataSet& whole : long_measurements(seed)) {
      for (const std::size_t station : {0U, 1U, 2U}) {
        const int joint = 1 + static_cast<int>(stream.index(3));
        std::vector<DataSet> sets = as_stations(whole, 3, stream);
        for (MeasuredPose& pose : sets[station].poses) pose.joints[joint] -= kBy_rad;
        const auto findings = check_stations(joined_stations(std::move(sets), StationTools::own));
        const std::string of = whole.robot.name + ", joint " + std::to_string(joint + 1) + ": ";
        // What a wrist's zero does, tools of the stations' own may take up.
        if (joint == 3 && findings.empty()) continue;
        ASSERT_EQ(findings.size(), 1U) << of << station_sentences(findings);
        EXPECT_EQ(findings.front().kind, FindingKind::joint_zero_changed) << of << station_sentences(findings);
        EXPECT_EQ(findings.front().joint, joint) << of << station_sentences(findings);
        EXPECT_EQ(findings.front().poses.size(), whole.poses.size() / 3) << of;
        EXPECT_THAT(findings.front().sentence,
                    HasSubstr("in " + std::string(1, static_cast<char>('A' + station)) + " "));
      }
    }
  }
}

TEST(StationsOfOneArm, OfAnArmThatWasChangedAllOverDiffer) {
  RandomStream stream{78};
  for (const DataSet& whole : long_measurements(78)) {
    std::vector<DataSet> sets = as_stations(whole, 2, stream);
    for (MeasuredPose& pose : sets[1].poses)
      for (int joint = 0; joint < whole.robot.chain.size(); ++joint)
        pose.joints[joint] += (joint % 2 == 0 ? 1.0 : -1.0) * 3e-3;
    const auto findings = check_stations(joined_stations(std::move(sets), StationTools::own));
    ASSERT_EQ(findings.size(), 1U) << whole.robot.name;
    EXPECT_EQ(findings.front().kind, FindingKind::stations_differ) << whole.robot.name << station_sentences(findings);
    EXPECT_LT(findings.front().if_changed_mm, findings.front().as_given_mm / 3.0);
  }
}

}  // namespace
}  // namespace demecal
