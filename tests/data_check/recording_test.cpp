// What recording does to values is named: coarse digits, joints read before the arm stood, drift without times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// The findings of a kind, as sentences.
std::vector<std::string> sentences(const DataCheck& check, FindingKind kind) {
  std::vector<std::string> all;
  for (const Finding& finding : check.findings)
    if (finding.kind == kind) all.push_back(finding.sentence);
  return all;
}

double rounded_to(double value, double step) {
  return step * std::round(value / step);
}

TEST(Recording, WhatIsRoundedCoarselyIsNamed) {
  for (const DataSet& right : long_measurements(5)) {
    EXPECT_FALSE(check_data(right).has(FindingKind::coarse_values)) << right.robot.name;
    DataSet positions = right;
    for (MeasuredPose& pose : positions.poses) pose.position_m->z() = rounded_to(pose.position_m->z(), 0.01);
    const auto told = sentences(check_data(positions), FindingKind::coarse_values);
    ASSERT_EQ(told.size(), 1U) << right.robot.name;
    EXPECT_NE(told.front().find("z to 10 mm only"), std::string::npos) << told.front();
    DataSet joints = right;
    for (MeasuredPose& pose : joints.poses) pose.joints[1] = rounded_to(pose.joints[1], radians(1.0));
    const DataCheck check = check_data(joints);
    ASSERT_TRUE(check.has(FindingKind::coarse_values)) << right.robot.name;
    for (const Finding& finding : check.findings) {
      if (finding.kind != FindingKind::coarse_values) continue;
      EXPECT_EQ(finding.joint, 1) << finding.sentence;
    }
  }
}

TEST(Recording, JointsThatWereSentToWholeDegreesAreNotCalledRounded) {
  for (const DataSet& right : long_measurements(6)) {
    DataSet sent = right;
    RandomStream random({1});
    for (MeasuredPose& pose : sent.poses) {
      for (double& joint : pose.joints) joint = rounded_to(joint, radians(1.0));
      pose.position_m = forward(sent.robot.chain, pose.joints) * nominal_tool(sent, pose);
      for (double& coordinate : *pose.position_m) coordinate += 1e-4 * random.normal();
    }
    EXPECT_FALSE(check_data(sent).has(FindingKind::coarse_values)) << right.robot.name;
  }
}

TEST(Recording, JointsThatWereReadBeforeTheArmStoodAreNamed) {
  for (const DataSet& right : long_measurements(7)) {
    EXPECT_FALSE(check_data(right).has(FindingKind::taken_in_motion)) << right.robot.name;
    DataSet early = right;
    for (std::size_t i = 1; i < early.poses.size(); ++i)
      early.poses[i].joints -= 0.003 * (right.poses[i].joints - right.poses[i - 1].joints);
    const auto told = sentences(check_data(early), FindingKind::taken_in_motion);
    ASSERT_EQ(told.size(), 1U) << right.robot.name;
    EXPECT_NE(told.front().find("0.3 % of every joint's way"), std::string::npos) << told.front();
    DataSet lost = right;
    for (std::size_t i = 1; i < lost.poses.size(); ++i)
      for (Eigen::Index joint = 0; joint < right.poses[i].joints.size(); ++joint)
        lost.poses[i].joints[joint] += right.poses[i].joints[joint] > right.poses[i - 1].joints[joint] ? 5e-4 : -5e-4;
    EXPECT_FALSE(check_data(lost).has(FindingKind::taken_in_motion)) << right.robot.name;
  }
}

/// Each pose once.
DataSet without_repeats(DataSet data) {
  const auto is_repeat = [](const MeasuredPose& one, const MeasuredPose& other) { return one.joints == other.joints; };
  data.poses.erase(std::unique(data.poses.begin(), data.poses.end(), is_repeat), data.poses.end());
  return data;
}

TEST(Recording, OneJointThatWasReadBeforeItStoodIsNamed) {
  for (const DataSet& repeated : long_measurements(15)) {
    const DataSet right = without_repeats(repeated);
    for (const Eigen::Index joint : {0, 2}) {
      DataSet early = right, lost = right, geared = right;
      for (std::size_t i = 1; i < right.poses.size(); ++i) {
        const double way = right.poses[i].joints[joint] - right.poses[i - 1].joints[joint];
        early.poses[i].joints[joint] -= 0.003 * way;
        lost.poses[i].joints[joint] += way > 0.0 ? 1e-3 : -1e-3;
        geared.poses[i].joints[joint] += 3e-3 * right.poses[i].joints[joint];
      }
      const DataCheck check = check_data(early);
      const auto told = sentences(check, FindingKind::taken_in_motion);
      ASSERT_EQ(told.size(), 1U) << right.robot.name << " " << joint << " of " << right.poses.size();
      const std::string begin = "Joint " + std::to_string(joint + 1) + " was read before it stood: ";
      ASSERT_TRUE(told.front().starts_with(begin)) << told.front();
      EXPECT_NEAR(std::stod(told.front().substr(begin.size())), 0.3, 0.04) << told.front();
      for (const Finding& finding : check.findings) {
        if (finding.kind == FindingKind::taken_in_motion) {
          EXPECT_EQ(finding.joint, joint) << finding.sentence;
        }
      }
      EXPECT_FALSE(check_data(lost).has(FindingKind::taken_in_motion)) << right.robot.name << " " << joint;
      EXPECT_FALSE(check_data(geared).has(FindingKind::taken_in_motion)) << right.robot.name << " " << joint;
    }
  }
}

TEST(Recording, WhatWasTakenWhileTheArmMovedIsNamed) {
  for (const DataSet& right : long_measurements(9)) {
    DataSet points = right, left = right;
    for (std::size_t i = 1; i + 1 < right.poses.size(); ++i) {
      points.poses[i].joints += 0.004 * (right.poses[i].joints - right.poses[i - 1].joints);
      left.poses[i].joints += 0.004 * (right.poses[i + 1].joints - right.poses[i].joints);
    }
    const auto told = [](const DataSet& data) {
      const auto all = sentences(check_data(data), FindingKind::taken_in_motion);
      return all.empty() ? std::string() : all.front();
    };
    EXPECT_TRUE(told(points).starts_with("Points were measured before the arm stood"))
        << right.robot.name << told(points);
    EXPECT_TRUE(told(left).starts_with("Joints were read after the arm had left")) << right.robot.name << told(left);
    // Rows in another order, with times.
    for (std::size_t i = 0; i < points.poses.size(); ++i) points.poses[i].time_s = 5.0 * static_cast<double>(i);
    std::ranges::reverse(points.poses);
    EXPECT_TRUE(told(points).starts_with("Points were measured before the arm stood"))
        << right.robot.name << told(points);
  }
}

TEST(Recording, WhatWasTakenFarFromTheStopIsNotAnotherRobots) {
  for (const DataSet& repeated : long_measurements(13)) {
    const DataSet right = without_repeats(repeated);
    for (const double share : {0.02, 0.13}) {
      DataSet early = right, left = right, points = right;
      for (std::size_t i = 0; i < right.poses.size(); ++i) {
        const JointVector& there = right.poses[i].joints;
        if (i > 0) early.poses[i].joints -= share * (there - right.poses[i - 1].joints);
        if (i + 1 < right.poses.size()) left.poses[i].joints += share * (right.poses[i + 1].joints - there);
        if (i > 0) points.poses[i].joints += share / (1.0 - share) * (there - points.poses[i - 1].joints);
      }
      const std::string how_much = share < 0.1 ? "2 % of every" : "13 % of every";
      for (const auto& [data, what] : {std::pair(early, "Joints were read before the arm stood"),
                                       std::pair(left, "Joints were read after the arm had left"),
                                       std::pair(points, "Points were measured before the arm stood")}) {
        const DataCheck check = check_data(data);
        const auto told = sentences(check, FindingKind::taken_on_the_way);
        ASSERT_EQ(told.size(), 1U) << right.robot.name << " " << what << " " << share
                                   << (check.findings.empty() ? "" : check.findings.front().sentence);
        EXPECT_TRUE(told.front().starts_with(what)) << told.front();
        EXPECT_NE(told.front().find(how_much), std::string::npos) << told.front();
        EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << right.robot.name << " " << what << " " << share;
      }
    }
  }
}

TEST(Recording, StepsOfHalvesAndFifthsAreToldAndRoundPlacesOfOneJointAreNot) {
  for (const DataSet& right : long_measurements(10)) {
    for (const double step_deg : {0.5, 0.2}) {
      DataSet coarse = right;
      RandomStream random({2});
      for (MeasuredPose& pose : coarse.poses) {
        pose.joints[0] = rounded_to(pose.joints[0], radians(30.0));
        pose.position_m = forward(coarse.robot.chain, pose.joints) * nominal_tool(coarse, pose);
        for (double& coordinate : *pose.position_m) coordinate += 5e-5 * random.normal();
        for (double& joint : pose.joints) joint = rounded_to(joint, radians(step_deg));
      }
      const auto told = sentences(check_data(coarse), FindingKind::coarse_values);
      ASSERT_EQ(told.size(), 1U) << right.robot.name << " " << step_deg;
      EXPECT_TRUE(
          told.front().starts_with(step_deg == 0.5 ? "Joints are written to 0.5 deg" : "Joints are written to 0.2 deg"))
          << told.front();
    }
  }
}

TEST(Recording, ErrorsOfGearsAreNotTakenForRounding) {
  for (const DataSet& right : long_measurements(11)) {
    DataSet sent = right;
    RandomStream random({3});
    for (MeasuredPose& pose : sent.poses) {
      for (double& joint : pose.joints) joint = rounded_to(joint, radians(0.1));
      JointVector real = pose.joints;
      real[1] += 8e-4 * std::sin(2.0 * real[1] + 0.4);
      real[2] += 6e-4 * std::cos(2.0 * real[2] - 0.3);
      pose.position_m = forward(sent.robot.chain, real) * nominal_tool(sent, pose);
      for (double& coordinate : *pose.position_m) coordinate += 5e-5 * random.normal();
    }
    EXPECT_FALSE(check_data(sent).has(FindingKind::coarse_values)) << right.robot.name;
  }
}

TEST(Recording, SidesMeasuredOneAfterTheOtherAreNoDrift) {
  for (const DataSet& right : long_measurements(12)) {
    DataSet blocks = right;
    for (std::size_t i = 0; i < blocks.poses.size(); ++i) {
      const double side = i < blocks.poses.size() / 2 ? 1.0 : -1.0;
      MeasuredPose& pose = blocks.poses[i];
      pose.approach = ApproachSigns::Constant(pose.joints.size(), side);
      pose.joints += JointVector::Constant(pose.joints.size(), 3e-4 * side);
    }
    EXPECT_FALSE(check_data(blocks).has(FindingKind::drift_without_times)) << right.robot.name;
  }
}

TEST(Recording, DriftIsNamedWhereNoTimesAreGiven) {
  for (const DataSet& right : long_measurements(8)) {
    EXPECT_FALSE(check_data(right).has(FindingKind::drift_without_times)) << right.robot.name;
    DataSet drifting = right;
    const auto n = static_cast<double>(drifting.poses.size());
    for (std::size_t i = 0; i < drifting.poses.size(); ++i)
      *drifting.poses[i].position_m += Eigen::Vector3d(1.2e-3, -5e-4, 2e-4) * static_cast<double>(i) / n;
    EXPECT_TRUE(check_data(drifting).has(FindingKind::drift_without_times)) << right.robot.name;
    for (std::size_t i = 0; i < drifting.poses.size(); ++i) drifting.poses[i].time_s = 10.0 * static_cast<double>(i);
    EXPECT_FALSE(check_data(drifting).has(FindingKind::drift_without_times)) << right.robot.name;
  }
}

TEST(Recording, AJointThatCountsTooMuchIsNoDrift) {
  for (const DataSet& right : long_measurements(5)) {
    for (const int joint : {0, 1}) {
      DataSet scaled = right;
      for (MeasuredPose& pose : scaled.poses) pose.joints[joint] *= 1.005;
      EXPECT_FALSE(check_data(scaled).has(FindingKind::drift_without_times)) << right.robot.name << joint;
    }
  }
}

TEST(Recording, DriftThereAndBackIsNamedAndNoMoveOfTheInstrument) {
  for (const DataSet& right : long_measurements(14)) {
    for (const int periods : {1, 2}) {
      DataSet drifting = right;
      const auto n = static_cast<double>(drifting.poses.size());
      for (std::size_t i = 0; i < drifting.poses.size(); ++i)
        *drifting.poses[i].position_m +=
            Eigen::Vector3d(1e-3, 4e-4, 0.0) * std::sin(kTurn_rad * periods * static_cast<double>(i) / n);
      const DataCheck check = check_data(drifting);
      const auto told = sentences(check, FindingKind::drift_without_times);
      ASSERT_EQ(told.size(), 1U) << right.robot.name << " " << periods;
      EXPECT_NE(told.front().find("there and back"), std::string::npos) << told.front();
      EXPECT_FALSE(check.has(FindingKind::instrument_moved)) << right.robot.name << " " << periods;
      for (std::size_t i = 0; i < drifting.poses.size(); ++i) drifting.poses[i].time_s = 10.0 * static_cast<double>(i);
      const DataCheck timed = check_data(drifting);
      EXPECT_FALSE(timed.has(FindingKind::drift_without_times)) << right.robot.name;
      EXPECT_FALSE(timed.has(FindingKind::instrument_moved)) << right.robot.name << " " << periods;
    }
  }
}

}  // namespace
}  // namespace demecal
