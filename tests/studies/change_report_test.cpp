// What `check` says of a robot names what it left out, and tells errors of the robot from those of the data.
#include "studies/change_report.hpp"

#include <gtest/gtest.h>

namespace demecal {
namespace {

bool says(const ChangeReport& change, const std::string& words, const std::string& name = "P") {
  DataSet data;
  data.robot.chain.joints.resize(6);
  for (const std::size_t line : {2U, 3U, 4U}) {
    MeasuredPose pose;
    pose.pose_id = name;
    pose.line = line;
    data.poses.push_back(pose);
  }
  return change_text(change, data, "model.yaml").find(words) != std::string::npos;
}

TEST(ChangeReport, NamesWhatWasLeftOutByItsLine) {
  ChangeReport change;
  change.poses = change.measurements = 2;
  EXPECT_FALSE(says(change, "left out"));
  EXPECT_FALSE(says(change, "measured 2 times"));
  change.outliers = {0, 2};
  EXPECT_TRUE(says(
      change, "left out, since they fit neither the robot as it was nor any change of it: P (line 2), P (line 4)"));
  EXPECT_TRUE(says(change, "any change of it: line 2, line 2 (line 4)", "line 2"));
  change.measurements = 6;
  EXPECT_TRUE(says(change, "2 poses measured 6 times"));
}

TEST(ChangeReport, TakesErrorsThatNoRobotComesToForThoseOfTheData) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.unnamed = true;
  change.error_m = 5e-4;
  EXPECT_FALSE(says(change, "Look at the rows first"));
  change.error_m = 5e-2;
  EXPECT_TRUE(says(change, "Look at the rows first"));
}

ChangeCause zero_of(int joint) {
  ChangeCause cause;
  cause.effect.kind = "joint_offset";
  cause.effect.joint = joint - 1;
  cause.effect.values = {1e-3};
  return cause;
}

TEST(ChangeReport, AdvisesOnEverythingThatWasFound) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.found = {zero_of(2), zero_of(3)};
  EXPECT_TRUE(says(change, "Look at joints 2 and 3:"));
  change.more = true;
  change.left_m = 1.5e-4;
  EXPECT_TRUE(says(change, "not all of it can be named"));
  EXPECT_TRUE(says(change, "0.15 mm (rms) are left"));
  EXPECT_TRUE(says(change, "before work on joints 2 and 3"));
}

}  // namespace
}  // namespace demecal
