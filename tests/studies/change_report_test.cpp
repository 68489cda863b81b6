// What `check` says of a robot names what it left out, and tells errors of the robot from those of the data.
#include "studies/change_report.hpp"

#include <gtest/gtest.h>

#include "studies/change_advice.hpp"

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
  EXPECT_TRUE(says(change, "whether the instrument scatters more"));
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

TEST(ChangeReport, SaysThatSoMuchMayBeAnotherRobot) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.found = {zero_of(2)};
  EXPECT_FALSE(says(change, "far more than"));
  change.implausible = true;
  EXPECT_TRUE(says(change, "This is far more than wear or a usual collision leaves"));
  EXPECT_TRUE(says(change, "Poses of another robot"));
  EXPECT_TRUE(says(change, "Look at joint 2: where a zero has moved, master it again"));
}

ChangeCause lost_motion_of(int joint, double by_model_rad, double size_rad) {
  ChangeCause cause;
  cause.effect = {.kind = "backlash", .joint = joint - 1, .form = "approach", .values = {size_rad}};
  cause.unit = "rad";
  cause.size = size_rad;
  cause.standard_error = 1e-5;
  cause.by_model = by_model_rad;
  return cause;
}

TEST(ChangeReport, TellsFromHowMuchToHowMuchLostMotionWent) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.found = {lost_motion_of(3, 3e-4, 6e-4)};
  EXPECT_TRUE(says(change, "The lost motion of joint 3, from end to end, went from 0.30 to 0.90 mrad"));
  EXPECT_TRUE(says(change, "Have the gear of joint 3 inspected"));
  EXPECT_FALSE(says(change, "master it again"));
  change.found = {lost_motion_of(3, 3e-4, -3.1e-4)};
  EXPECT_TRUE(says(change, "went from 0.30 to 0.00 mrad"));
  EXPECT_TRUE(says(change, "The lost motion of joint 3 is less than the model corrects for"));
  EXPECT_FALSE(says(change, "beyond where it is sent"));
  EXPECT_FALSE(says(change, "inspected"));
  change.found = {lost_motion_of(3, 0.0, 3e-4)};
  EXPECT_TRUE(says(change, "Joint 3 stops 0.15 mrad"));
  EXPECT_TRUE(says(change, "Have the gear of joint 3 inspected"));
}

TEST(ChangeReport, SaysThatAJointStopsBeyondWhereItIsSentOfTheWholeAlone) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.found = {lost_motion_of(3, 3e-4, -6e-4)};
  EXPECT_TRUE(says(change, "Joint 3 stops 0.15 mrad (30.9 arcsec) beyond where it is sent"));
  EXPECT_TRUE(says(change, "signs of approach of joint 3"));
}

TEST(ChangeReport, OfAnEffectByTemperatureStatesTheWhole) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  ChangeCause cause;
  cause.effect = {.kind = "thermal_offset", .joint = 1, .settings = {{"reference_celsius", 20.0}}, .values = {1e-5}};
  cause.unit = "rad/K";
  cause.size = 1e-5;
  cause.by_model = 2e-5;
  change.found = {cause};
  EXPECT_TRUE(says(change, "The zero of joint 2 moves by 0.03 mrad"));
  EXPECT_TRUE(says(change, "By the model it was 2e-05 rad/K, now it is 3e-05."));
}

TEST(ChangeReport, SaysRightAfterTheVerdictWhichZerosThePosesDoNotSee) {
  ChangeReport change;
  change.unseen_zeros = {{5, "The zero of joint 6 cannot be seen."}};
  EXPECT_TRUE(
      says(change, "As far as these poses can tell, the robot is as it was.\n  The zero of joint 6 cannot be seen.\n"));
  EXPECT_FALSE(says(change, "Nothing needs to be done."));
  const std::string json = to_json(change, DataSet{}, "model.yaml");
  EXPECT_NE(json.find("\"not_testable\":[\"The zero of joint 6 cannot be seen.\"]"), std::string::npos);
  EXPECT_NE(json.find("\"unseen_zeros\":[6]"), std::string::npos);
  EXPECT_NE(json.find("\"orientation_noise_deg\":null"), std::string::npos);
  change.orientation_rad = 1e-4;
  EXPECT_TRUE(says(change, "and 0.0057 deg per axis"));
  EXPECT_NE(to_json(change, DataSet{}, "model.yaml").find("\"orientations_judged\":true"), std::string::npos);
}

TEST(ChangeReport, SaysWhatWasFoundAndWhatToDoBeforeWhatThePosesDoNotSee) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  change.found = {zero_of(2)};
  change.unseen_zeros = {{5, "The zero of joint 6 cannot be seen."}};
  change.lacking = {"The temperature is not stated."};
  const std::string to_do = what_to_do(change, "model.yaml");
  EXPECT_TRUE(says(change, to_do + "\n  The temperature is not stated.\n  The zero of joint 6 cannot be seen.\n"));
  DataSet data;
  data.robot.chain.joints.resize(6);
  const std::string json = to_json(change, data, "model.yaml");
  EXPECT_LT(json.find("\"advice\""), json.find("\"not_testable\""));
  change.found.clear();
  change.unnamed = true;
  EXPECT_TRUE(says(change, "model.yaml.\n  The temperature is not stated.\n"));
}

TEST(ChangeReport, TakesTheZeroOfAJointForHeatFirstWhereThatDoesAsMuch) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  ChangeCause heat;
  heat.effect = {.kind = "thermal_offset", .joint = 1, .settings = {{"reference_celsius", 28.0}}, .values = {5e-5}};
  heat.unit = "rad/K";
  change.found = {zero_of(2), heat};
  EXPECT_TRUE(says(change, "Look at joint 2: where a zero has moved, master it again"));
  EXPECT_TRUE(says(change, "correct what the temperature does to joint 2"));
  EXPECT_FALSE(says(change, "Look at joint 2."));
  change.warmed = {{1, 28.0, 20.0, {}, true}};
  EXPECT_TRUE(says(change, "at 28.0 °C, the mean of these poses; at 20.0 °C it is where the model has it, which"));
  EXPECT_TRUE(says(change, "Look at the temperature first: heat alone may do what was found of joint 2"));
  EXPECT_FALSE(says(change, "where a zero has moved"));
  change.warmed = {{1, 28.0, 90.0, 20.0, false}};
  EXPECT_TRUE(says(change, "at 20.0 °C, the model's reference, it is off as well."));
  EXPECT_TRUE(says(change, "where a zero has moved, master it again"));
}

TEST(ChangeReport, LooksAtTheTargetBeforeTheZeroOfALastJoint) {
  ChangeReport change;
  change.verdict = ChangeVerdict::changed;
  ChangeCause tool;
  tool.effect = {.kind = "tool", .form = "pose"};
  change.found = change.tried = {zero_of(6)};
  change.tried.push_back(tool);
  EXPECT_FALSE(says(change, "turned or shifted on the flange"));
  change.found.front().rivals = {"tool (pose)"};
  EXPECT_TRUE(says(change, "See first whether the target was turned or shifted on the flange"));
}

TEST(ChangeReport, SaysFirstWhatPosesDoNotState) {
  ChangeReport change;
  change.lacking = {"The temperature is not stated."};
  EXPECT_TRUE(
      says(change, "As far as these poses can tell, the robot is as it was.\n  The temperature is not stated.\n"));
  EXPECT_TRUE(says(change, "state with the poses what is missing"));
  EXPECT_FALSE(says(change, "Nothing needs to be done"));
  change.not_testable = {"Repeats scatter."};
  const std::string json = to_json(change, DataSet{}, "model.yaml");
  EXPECT_NE(json.find("\"not_testable\":[\"The temperature is not stated.\",\"Repeats scatter.\"]"), std::string::npos);
}

}  // namespace
}  // namespace demecal
