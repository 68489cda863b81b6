// A mistake in many rows, though not in most: on every arm it is named with its rows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "kinematics/units.hpp"
#include "measured_arm.hpp"
#include "mistaken_case.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

std::vector<Robot> measured_robots() {
  return bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots");
}

/// Data sets of 150 poses on every arm.
std::vector<DataSet> arms_measured(std::uint64_t seed) {
  std::vector<DataSet> all;
  for (const Robot& arm : measured_robots()) {
    // The tenth make has 150 poses and more.
    auto cases = bench::unmistaken_cases({arm}, 10, {.seed = seed});
    all.push_back(std::move(cases.back().data));
  }
  return all;
}

struct PartMistake {
  FindingKind kind;
  std::string words;
  std::function<void(MeasuredPose&)> make;
};

std::vector<PartMistake> part_mistakes() {
  return {{FindingKind::joint_sign, "joint 3 is taken with the other sign",
           [](MeasuredPose& pose) { pose.joints[2] *= -1.0; }},
          {FindingKind::joint_offset, "-90 deg are added to joint 4",
           [](MeasuredPose& pose) { pose.joints[3] += radians(90.0); }},
          {FindingKind::joint_offset, "deg are added to joint 3",
           [](MeasuredPose& pose) { pose.joints[2] += radians(2.5); }},
          {FindingKind::joints_exchanged, "the columns of joints 4 and 5 are exchanged",
           [](MeasuredPose& pose) { std::swap(pose.joints[3], pose.joints[4]); }},
          {FindingKind::unit, "positions are in inches", [](MeasuredPose& pose) { *pose.position_m /= 25.4; }},
          {FindingKind::mirrored, "z of the measured point is negated",
           [](MeasuredPose& pose) { pose.position_m->z() *= -1.0; }}};
}

const Finding* first_of(const DataCheck& check, FindingKind kind) {
  for (const Finding& finding : check.findings)
    if (finding.kind == kind) return &finding;
  return nullptr;
}

std::string all_sentences(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

TEST(RowGroups, AMistakeInSomeOfTheRowsIsNamedWithThem) {
  for (const std::uint64_t seed : {3, 4}) {
    for (const DataSet& right : arms_measured(seed)) {
      for (const PartMistake& mistake : part_mistakes()) {
        for (const auto& [first, last] : {std::pair(0.7, 1.0), std::pair(0.3, 0.55)}) {
          DataSet data = right;
          std::set<std::string> wrong;
          const auto n = static_cast<double>(data.poses.size());
          for (auto i = static_cast<std::size_t>(first * n); i < static_cast<std::size_t>(last * n); ++i) {
            mistake.make(data.poses[i]);
            wrong.insert(data.poses[i].pose_id);
          }
          const DataCheck check = check_data(data);
          const std::string of = data.robot.name + ", " + mistake.words + ":\n" + all_sentences(check);
          EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << of;
          const Finding* finding = first_of(check, mistake.kind);
          ASSERT_NE(finding, nullptr) << of;
          EXPECT_THAT(finding->sentence, ::testing::HasSubstr(mistake.words)) << of;
          EXPECT_GT(finding->poses.size(), 3 * wrong.size() / 4) << of;
          for (const std::string& pose : finding->poses) EXPECT_TRUE(wrong.contains(pose)) << pose << of;
        }
      }
    }
  }
}

/// 60 calibration poses, of an arm whose joints err by `gears_rad` twice a turn.
DataSet sixty_poses(const Robot& arm, double gears_rad) {
  RandomStream random{7};
  Scenario scenario = bench::scenario_of(arm, {.poses = {60, 0, 0}}, random);
  for (int joint = 0; joint < arm.chain.size(); ++joint)
    scenario.gear_harmonics.push_back({joint, 2.0, gears_rad, -gears_rad});
  DataSet data = bench::dealt(scenario);
  for (MeasuredPose& pose : data.poses) pose.set = PoseSet::calibration;
  return data;
}

TEST(RowGroups, TheLastRowsInAnotherUnitAreNoOutliersAndNoMoveOfTheInstrument) {
  for (const Robot& arm : measured_robots()) {
    for (const double gears_rad : {0.0, 2e-3}) {
      const DataSet right = sixty_poses(arm, gears_rad);
      EXPECT_EQ(check_data(right).verdict(), DataVerdict::plausible) << arm.name << all_sentences(check_data(right));
      for (const double factor : {1e-3, 1 / 25.4, 0.1, 1e3}) {
        for (const std::size_t rows : {6, 10}) {
          DataSet wrong = right;
          for (std::size_t i = 60 - rows; i < 60; ++i) *wrong.poses[i].position_m *= factor;
          const DataCheck check = check_data(wrong);
          const std::string of = arm.name + "\n" + all_sentences(check);
          EXPECT_FALSE(check.has(FindingKind::instrument_moved)) << of;
          const Finding* finding = first_of(check, FindingKind::unit);
          ASSERT_NE(finding, nullptr) << of;
          EXPECT_EQ(finding->poses.size(), rows) << of;
        }
      }
    }
  }
}

TEST(RowGroups, ASetThatIsReadOtherwiseIsNotMeasuredInAnotherFrame) {
  const std::vector<PartMistake> mistakes{{FindingKind::unit, "positions are in metres where millimetres are stated",
                                           [](MeasuredPose& pose) { *pose.position_m *= 1e-3; }},
                                          {FindingKind::joint_sign, "joint 5 is taken with the other sign",
                                           [](MeasuredPose& pose) { pose.joints[4] *= -1; }},
                                          {FindingKind::joints_exchanged, "the columns of joints 1 and 2 are exchanged",
                                           [](MeasuredPose& pose) { std::swap(pose.joints[0], pose.joints[1]); }}};
  for (const DataSet& right : arms_measured(8)) {
    for (const PartMistake& mistake : mistakes) {
      for (const PoseSet set : {PoseSet::validation, PoseSet::accept}) {
        DataSet data = right;
        for (const std::size_t pose : poses_of(data, set)) mistake.make(data.poses[pose]);
        const DataCheck check = check_data(data);
        const std::string of = data.robot.name + ", " + mistake.words + ":\n" + all_sentences(check);
        ASSERT_EQ(check.findings.size(), 1u) << of;
        EXPECT_EQ(check.findings.front().kind, mistake.kind) << of;
        EXPECT_THAT(check.findings.front().sentence, ::testing::HasSubstr(mistake.words)) << of;
        EXPECT_GT(check.findings.front().poses.size(), 9 * poses_of(data, set).size() / 10) << of;
        EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << of;
      }
    }
  }
}

TEST(RowGroups, RowsOffByOneInTheMiddleAreNamed) {
  for (const DataSet& right : arms_measured(5)) {
    DataSet data = right;
    const std::size_t n = data.poses.size();
    for (std::size_t i = n / 3; i < n / 3 + n / 4; ++i) data.poses[i].position_m = right.poses[i + 1].position_m;
    const DataCheck check = check_data(data);
    const Finding* finding = first_of(check, FindingKind::rows_shifted);
    ASSERT_NE(finding, nullptr) << data.robot.name << all_sentences(check);
    EXPECT_THAT(finding->sentence, ::testing::HasSubstr("each measured point is taken from 1 row further up"))
        << data.robot.name;
    EXPECT_LT(finding->poses.size(), n / 4 + 2) << data.robot.name;
  }
}

TEST(RowGroups, TargetsExchangedInSomeRowsAreNamed) {
  for (const bench::MistakenCase& one : bench::unmistaken_cases(measured_robots(), 25)) {
    if (one.what != "several targets" || one.data.poses.size() < 60) continue;
    std::set<std::string> targets;
    for (const MeasuredPose& pose : one.data.poses) targets.insert(pose.target);
    const std::string first = *targets.begin(), second = *std::next(targets.begin());
    DataSet data = one.data;
    for (std::size_t i = data.poses.size() / 2; i < data.poses.size(); ++i) {
      MeasuredPose& pose = data.poses[i];
      pose.target = pose.target == first ? second : pose.target == second ? first : pose.target;
    }
    const DataCheck check = check_data(data);
    EXPECT_TRUE(check.has(FindingKind::targets_exchanged)) << one.arm << all_sentences(check);
    EXPECT_EQ(check_data(one.data).verdict(), DataVerdict::plausible) << one.arm;
  }
}

TEST(RowGroups, WhatNothingExplainsIsRefusedAllTheSame) {
  RandomStream random{9};
  for (const DataSet& right : arms_measured(6)) {
    DataSet data = right;
    for (std::size_t i = 0; i < data.poses.size(); i += 3)
      for (double& value : *data.poses[i].position_m) value += random.real(-0.5, 0.5);
    const DataCheck check = check_data(data);
    EXPECT_TRUE(check.has(FindingKind::many_outliers)) << data.robot.name << all_sentences(check);
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << data.robot.name;
  }
}

/// Points of the poses from `first` on, each taken from the pose after it; the last keeps its own.
DataSet shifted_from(const DataSet& right, std::size_t first) {
  DataSet data = right;
  for (std::size_t i = first; i + 1 < data.poses.size(); ++i) data.poses[i].position_m = right.poses[i + 1].position_m;
  return data;
}

/// Poses in the order of their sets, as a person writes them down.
DataSet by_sets(DataSet data) {
  std::ranges::stable_sort(data.poses, {}, &MeasuredPose::set);
  return data;
}

TEST(RowGroups, ShiftedRowsOfASetThatWasNotFittedAreAContradiction) {
  for (const DataSet& mixed : arms_measured(11)) {
    const DataSet right = by_sets(mixed);
    for (const PoseSet set : {PoseSet::validation, PoseSet::accept}) {
      DataSet data = right;
      const std::vector<std::size_t> poses = poses_of(right, set);
      for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        data.poses[poses[i]].position_m = right.poses[poses[i + 1]].position_m;
      const DataCheck check = check_data(data);
      const std::string of = data.robot.name + "\n" + all_sentences(check);
      const Finding* finding = first_of(check, FindingKind::rows_shifted);
      ASSERT_NE(finding, nullptr) << of;
      EXPECT_THAT(finding->sentence, ::testing::HasSubstr(std::string(to_string(set)) + " rows")) << of;
      EXPECT_GT(finding->poses.size(), 9 * poses.size() / 10) << of;
      EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << of;
    }
  }
}

TEST(RowGroups, AShiftFromAFewCalibrationRowsBeforeTheEndOnIsNamed) {
  for (const DataSet& mixed : arms_measured(12)) {
    const DataSet right = by_sets(mixed);
    const std::size_t calibration = poses_of(right, PoseSet::calibration).size();
    for (const std::size_t before : {6, 10}) {
      const DataCheck check = check_data(shifted_from(right, calibration - before));
      EXPECT_TRUE(check.has(FindingKind::rows_shifted)) << right.robot.name << before << all_sentences(check);
      EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << right.robot.name;
    }
  }
}

TEST(RowGroups, AShuffledSetThatWasNotFittedIsAContradiction) {
  RandomStream random{13};
  for (const DataSet& right : arms_measured(13)) {
    for (const PoseSet set : {PoseSet::validation, PoseSet::accept}) {
      DataSet data = right;
      const std::vector<std::size_t> poses = poses_of(right, set);
      for (std::size_t i = poses.size() - 1; i > 0; --i)
        std::swap(data.poses[poses[i]].position_m, data.poses[poses[random.index(i + 1)]].position_m);
      const DataCheck check = check_data(data);
      EXPECT_TRUE(check.has(FindingKind::many_outliers)) << data.robot.name << all_sentences(check);
      EXPECT_EQ(check.verdict(), DataVerdict::contradiction) << data.robot.name;
    }
  }
}

TEST(RowGroups, AJointOffInASetThatWasNotFittedIsToldFromATurnedFrame) {
  for (const DataSet& right : arms_measured(14)) {
    for (const int joint : {0, 1, 2}) {
      DataSet data = right;
      for (const std::size_t pose : poses_of(data, PoseSet::validation)) data.poses[pose].joints[joint] += radians(5.0);
      const DataCheck check = check_data(data);
      const std::string of = data.robot.name + "\n" + all_sentences(check);
      ASSERT_EQ(check.findings.size(), 1u) << of;
      const Finding& finding = check.findings.front();
      // The first joint turns all points about the base, as another frame does.
      EXPECT_EQ(finding.kind, joint == 0 ? FindingKind::set_in_other_frame : FindingKind::joint_offset) << of;
      EXPECT_EQ(finding.joint, joint == 0 ? -1 : joint) << of;
    }
  }
}

}  // namespace
}  // namespace demecal
