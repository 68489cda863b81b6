// The public interface: an arm and measurements built in memory or read, calibrated in this process.
#include "library/demecal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

const std::string kConfigs = std::string(DEMECAL_SOURCE_DIR) + "/configs/";
const std::string kDemo = kConfigs + "data/puma761-demo/dataset.yaml";

/// 3 joints that turn, of some 1.2 m.
ArmDescription short_arm() {
  ArmDescription description;
  description.name = "short";
  for (const ArmLink& link : {ArmLink{.alpha_deg = -90, .d_mm = 300}, ArmLink{.a_mm = 500}, ArmLink{.a_mm = 400}})
    description.links.push_back(link);
  description.tool_mm = {20, 0, 30};
  return description;
}

/// Positions of the short arm, whose base stands 100 mm along x of the instrument's frame, and whose joint 2 stands
/// 0.5 mrad beyond what it is told.
std::vector<PoseMeasurement> measured_short_arm() {
  const Arm arm(short_arm());
  std::vector<PoseMeasurement> poses;
  for (int i = 0; i < 40; ++i) {
    const double turn = 2.4 * i;
    PoseMeasurement pose;
    pose.command.joints = {100 * std::sin(turn), 60 * std::cos(1.7 * turn), 80 * std::sin(0.6 * turn + 1)};
    std::vector<double> real = pose.command.joints;
    real[1] += 0.5e-3 * 57.29577951308232;
    pose.position_mm = arm.pose(real).position_mm;
    pose.position_mm[0] += 100;
    pose.position_mm[2] += 1e-2 * std::sin(91.0 * i);  // what the instrument adds
    poses.push_back(pose);
  }
  return poses;
}

CalibrationSettings fitted_only() {
  CalibrationSettings settings;
  settings.declared = {"registration", "joint_offset"};
  settings.max_effects = 0;
  return settings;
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(LibraryArm, StandsWhereItsLinksSay) {
  const ToolPose pose = Arm(short_arm()).pose({0, 0, 0});
  EXPECT_NEAR(pose.position_mm[0], 920, 1e-9);
  EXPECT_NEAR(pose.position_mm[1], 30, 1e-9);
  EXPECT_NEAR(pose.position_mm[2], 300, 1e-9);
}

TEST(LibraryArm, RefusesWhatIsNoArm) {
  EXPECT_THAT([] { Arm(ArmDescription{}); }, ThrowsMessage<std::runtime_error>(HasSubstr("from 1 to 9 joints")));
  EXPECT_THAT([] { Arm(short_arm()).pose({0, 0}); }, ThrowsMessage<std::runtime_error>(HasSubstr("has 3 joints")));
}

TEST(LibraryMeasurements, AreReadAndDividedAsTheProgramDoes) {
  const Measurements measured = Measurements::load(kDemo);
  EXPECT_EQ(measured.arm().name(), "PUMA 761");
  EXPECT_EQ(measured.arm().joints(), 6);
  EXPECT_EQ(measured.size(), measured.count(PoseUse::calibration) + measured.count(PoseUse::validation) +
                                 measured.count(PoseUse::accept));
  EXPECT_THAT(measured.findings(), IsEmpty());
}

TEST(LibraryMeasurements, BuiltInMemoryAreDividedByPose) {
  const Measurements measured(Arm(short_arm()), measured_short_arm());
  EXPECT_EQ(measured.count(PoseUse::calibration), 28U);
  EXPECT_EQ(measured.count(PoseUse::validation), 12U);
}

TEST(LibraryMeasurements, SayWhichSignIsWrong) {
  std::vector<PoseMeasurement> poses = measured_short_arm();
  for (PoseMeasurement& pose : poses) pose.command.joints[1] *= -1;
  const Measurements measured(Arm(short_arm()), poses);
  EXPECT_TRUE(measured.contradict_arm());
  EXPECT_THAT([&] { calibrate(measured); }, ThrowsMessage<std::runtime_error>(HasSubstr("joint 2")));
}

TEST(LibraryCalibration, FindsAJointOffset) {
  const Measurements measured(Arm(short_arm()), measured_short_arm());
  const CalibratedArm arm = calibrate(measured, fitted_only());
  EXPECT_LT(arm.errors(measured, PoseUse::validation).rms_mm, 0.05);
  EXPECT_THAT(arm.effects(), IsEmpty());
  const std::vector<double> sent = arm.correct({{10, 20, 30}});
  ASSERT_EQ(sent.size(), 3U);
  EXPECT_NEAR(sent[1] - 20, -0.5e-3 * 57.29577951308232, 3e-3);
}

TEST(LibraryCalibration, SaysOfEveryPoseHowFarItIsOffAndHowFarThatWasToBeExpected) {
  const Measurements measured(Arm(short_arm()), measured_short_arm());
  const CalibratedArm arm = calibrate(measured, fitted_only());
  const std::vector<PoseError> errors = arm.pose_errors(measured);
  ASSERT_EQ(errors.size(), measured.size());
  double squares_mm2 = 0.0;
  std::size_t validated = 0, within = 0;
  for (const PoseError& pose : errors) {
    within += pose.error_mm <= pose.interval95_mm ? 1 : 0;
    if (pose.use != PoseUse::validation) continue;
    squares_mm2 += pose.error_mm * pose.error_mm;
    ++validated;
  }
  EXPECT_EQ(validated, measured.count(PoseUse::validation));
  EXPECT_NEAR(std::sqrt(squares_mm2 / static_cast<double>(validated)), arm.errors(measured, PoseUse::validation).rms_mm,
              1e-12);
  EXPECT_GE(within, 34U);
}

TEST(LibraryCalibration, SaysHowFarOffTheCorrectedToolMayBe) {
  const Arm nominal(short_arm());
  const CalibratedArm arm = calibrate(Measurements(nominal, measured_short_arm()), fitted_only());
  constexpr int kCommands = 200;
  int within = 0;
  double wider_by = 0.0;
  for (int i = 0; i < kCommands; ++i) {
    const JointCommand command{{90 * std::sin(3.1 * i), 50 * std::cos(1.9 * i), 70 * std::sin(0.7 * i)}};
    std::vector<double> real = arm.correct(command);
    real[1] += 0.5e-3 * 57.29577951308232;
    const auto at = nominal.pose(real).position_mm, meant = nominal.pose(command.joints).position_mm;
    const double off_mm = std::hypot(at[0] - meant[0], at[1] - meant[1], at[2] - meant[2]);
    within += off_mm <= arm.error95_mm(command) ? 1 : 0;
    const JointCommand beyond{{command.joints[0], 120, command.joints[2]}};
    wider_by += (arm.error95_mm(beyond) - arm.error95_mm(command)) / kCommands;
  }
  EXPECT_GE(within, kCommands * 9 / 10);
  EXPECT_GT(wider_by, 0.0) << "joint 2 was measured within 60 deg";
  EXPECT_TRUE(arm.widened_by({{0, 0, 0}}).empty());
  ASSERT_EQ(arm.widened_by({{0, 120, 0}}).size(), 1U);
  EXPECT_TRUE(arm.widened_by({{0, 120, 0}})[0].starts_with("joint 2 at 120 deg, measured -"));
  EXPECT_LT(arm.error95_mm({{0, 0, 0}}), 0.2) << "1 mm would hold everything";
}

TEST(LibraryCalibration, PredictsWhereTheToolReallyIs) {
  const std::vector<PoseMeasurement> poses = measured_short_arm();
  const CalibratedArm arm = calibrate(Measurements(Arm(short_arm()), poses), fitted_only());
  for (const PoseMeasurement& pose : poses) {
    const ToolPose predicted = arm.predict(pose.command);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(predicted.position_mm[axis], pose.position_mm[axis], 0.1);
  }
}

TEST(LibraryCalibration, HasTheSameBitsOnAnyNumberOfThreadsAndOfTheSavedModel) {
  CalibrationSettings settings;
  settings.max_effects = 0;
  settings.job_file = kConfigs + "jobs/demo.yaml";
  const Measurements measured = Measurements::load(kDemo);
  settings.threads = 1;
  const CalibratedArm one = calibrate(measured, settings);
  settings.threads = 3;
  const CalibratedArm other = calibrate(measured, settings);
  const std::string file = ::testing::TempDir() + "library_test_model.yaml";
  one.save(file);
  const std::string first = text_of_file(file);
  other.save(file);
  EXPECT_EQ(text_of_file(file), first);
  const JointCommand command{{10, -80, 120, 0, 40, 0}};
  const CalibratedArm loaded = CalibratedArm::load(file);
  EXPECT_EQ(loaded.predict(command).position_mm, other.predict(command).position_mm);
  EXPECT_EQ(loaded.correct(command), other.correct(command));
  EXPECT_LT(one.errors(measured, PoseUse::validation).rms_mm, 0.5);
}

TEST(LibraryCalibration, TellsWhatItDoesAndStopsWhenToldTo) {
  std::vector<std::string> told;
  CalibrationSettings settings = fitted_only();
  settings.max_effects = 5;
  settings.progress = [&told](const std::string& sentence) {
    told.push_back(sentence);
    return false;
  };
  const CalibratedArm arm = calibrate(Measurements(Arm(short_arm()), measured_short_arm()), settings);
  EXPECT_THAT(told, ElementsAre("calibrating 40 poses of short"));
  EXPECT_THAT(arm.effects(), IsEmpty());
}

TEST(LibraryProgram, IsCorrectedOnceAndKeepsItsText) {
  const CalibratedArm arm = calibrate(Measurements(Arm(short_arm()), measured_short_arm()), fitted_only());
  const std::string program = "q1_deg,q2_deg,q3_deg\n10,20,30\n-40,10,50\n";
  std::vector<std::string> warnings;
  const std::string corrected = arm.correct_program(program, "moves.csv", &warnings);
  EXPECT_NE(corrected, program);
  EXPECT_THAT(corrected, HasSubstr("q1_deg,q2_deg,q3_deg"));
  EXPECT_THAT([&] { arm.correct_program(corrected, "moves.csv"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("corrected already")));
}

}  // namespace
}  // namespace demecal
