// What a fitted model says of the data: links far from their description, other frames, and what it explains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "data_check/check_data.hpp"
#include "fitting/fit.hpp"
#include "kinematics/units.hpp"
#include "long_measurements.hpp"
#include "mistaken_case.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const Robot& benchmark_arm() {
  static const Robot arm = bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots").at(1);
  return arm;
}

std::string said_of(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

TEST(CheckFitted, NamesALinkThatIsFittedFarFromItsDescription) {
  const DataSet data = bench::unmistaken_cases({benchmark_arm()}, 1).front().data;
  CorrectedRobot robot = fit_registration(data, poses_of(data, PoseSet::calibration),
                                          {.registration = true, .tool = true}, nominal_robot(data))
                             .robot;
  robot.chain.joints[3].a_m += 0.014;
  robot.chain.joints[4].theta_rad += radians(2.9);
  DataCheck near, far;
  check_fitted(data, robot, near);
  EXPECT_FALSE(near.has(FindingKind::implausible_link));
  robot.chain.joints[1].a_m += 0.05;
  robot.chain.joints[1].theta_rad -= radians(5.0);
  check_fitted(data, robot, far);
  ASSERT_TRUE(far.has(FindingKind::implausible_link));
  const Finding& finding = far.findings.front();
  EXPECT_EQ(finding.joint, 1);
  EXPECT_FALSE(contradicts(finding.kind));
  EXPECT_THAT(finding.sentence, HasSubstr("Joint 2 and its link are fitted far from the robot's description: theta"));
}

TEST(CheckDeclared, RefusesAFitWithoutABaseInAnotherFrame) {
  DataSet data = bench::unmistaken_cases({benchmark_arm()}, 1).front().data;
  for (const DeclaredModel& declared : {DeclaredModel{.tool = true, .geometry = true}, DeclaredModel{}}) {
    DataCheck check;
    check_declared(data, declared, check);
    ASSERT_TRUE(check.has(FindingKind::undeclared_registration));
    EXPECT_EQ(check.verdict(), DataVerdict::contradiction);
    EXPECT_THAT(said_of(check), HasSubstr("`registration` is not declared"));
  }
  DataCheck with_base, in_its_frame;
  check_declared(data, {.registration = true, .tool = true}, with_base);
  EXPECT_TRUE(with_base.findings.empty());
  const CorrectedRobot placed = fit_registration(data, poses_of(data, PoseSet::calibration),
                                                 {.registration = true, .tool = true}, nominal_robot(data))
                                    .robot;
  for (MeasuredPose& pose : data.poses)
    if (pose.position_m) *pose.position_m = placed.sensor_from_base.inverse() * *pose.position_m;
  check_declared(data, {.tool = true, .geometry = true}, in_its_frame);
  EXPECT_TRUE(in_its_frame.findings.empty()) << said_of(in_its_frame);
}

TEST(CheckFitted, TakesBackWhatTheModelExplains) {
  DataSet data = bench::unmistaken_cases({benchmark_arm()}, 1).front().data;
  const Fit fit = fit_registration(data, poses_of(data, PoseSet::calibration), {.registration = true, .tool = true},
                                   nominal_robot(data));
  const std::string id = data.poses[4].pose_id;
  const Finding of_pose{.kind = FindingKind::outlier, .poses = {id}};
  Finding of_set{.kind = FindingKind::set_in_other_frame};
  for (const std::size_t i : poses_of(data, PoseSet::validation)) of_set.poses.push_back(data.poses[i].pose_id);
  ASSERT_FALSE(of_set.poses.empty());
  DataCheck explained{{of_pose, of_set}}, off{{of_pose, of_set}};
  check_fitted(data, fit.robot, explained);
  EXPECT_FALSE(explained.has(FindingKind::outlier)) << said_of(explained);
  EXPECT_FALSE(explained.has(FindingKind::set_in_other_frame)) << said_of(explained);
  data.poses[4].position_m->x() += 0.05;
  for (const std::size_t i : poses_of(data, PoseSet::validation)) data.poses[i].position_m->y() += 0.02;
  check_fitted(data, fit.robot, off);
  EXPECT_TRUE(off.has(FindingKind::outlier)) << said_of(off);
  EXPECT_TRUE(off.has(FindingKind::set_in_other_frame)) << said_of(off);
}

TEST(CheckFitted, SaysThatALaterMeasurementStandsInAnotherFrameUnlessItStandsInTwo) {
  DataSet data = bench::unmistaken_cases({benchmark_arm()}, 1).front().data;
  const Fit fit = fit_registration(data, poses_of(data, PoseSet::calibration), {.registration = true, .tool = true},
                                   nominal_robot(data));
  DataCheck before, after, in_two{{{.kind = FindingKind::instrument_moved}}};
  check_fitted(data, fit.robot, before);
  EXPECT_FALSE(before.has(FindingKind::set_in_other_frame)) << said_of(before);
  for (MeasuredPose& pose : data.poses) *pose.position_m += Eigen::Vector3d(0.02, 0.01, -0.015);
  check_fitted(data, fit.robot, after);
  EXPECT_TRUE(after.has(FindingKind::set_in_other_frame)) << said_of(after);
  check_fitted(data, fit.robot, in_two);
  EXPECT_FALSE(in_two.has(FindingKind::set_in_other_frame)) << said_of(in_two);
}

}  // namespace
}  // namespace demecal
