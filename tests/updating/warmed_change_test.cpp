// A zero that is off because the arm is warmer than at its calibration is told from one that moved.
#include <gtest/gtest.h>

#include <string>

#include "lacking_numbers.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal {
namespace {

/// Joint 3 warms from 25 to 39 degrees; calibrated was at 20.
ChangeReport checked_warm(const CalibratedModel& model, double moved_rad, std::uint64_t draw) {
  CorrectedRobot now = true_wrist(1);
  now.effects = {{.kind = "thermal_offset", .joint = 2, .settings = {{"reference_celsius", 20.0}}, .values = {5e-5}}};
  now.chain.joints[2].theta_rad += moved_rad;
  DataSet data = measured_wrist(now, 15, 0, draw);
  RandomStream random{9307, draw};
  double celsius = 24.0;
  for (MeasuredPose& pose : data.poses) {
    pose.temperature_celsius = celsius += 1.0;
    pose.position_m = now.predict(Stop(pose), "").translation() +
                      kMeasured_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return find_change(model, data);
}

CalibratedModel cold_model() {
  return model_of_wrist(measured_wrist(true_wrist(1), 60, 30, 1));
}

TEST(WarmedZero, IsWhereTheModelHasItAtTheTemperatureOfTheCalibration) {
  for (const std::uint64_t draw : {930U, 931U, 932U}) {
    const ChangeReport report = checked_warm(cold_model(), 0.0, draw);
    ASSERT_EQ(report.warmed.size(), 1U);
    const WarmedZero& zero = report.warmed.front();
    EXPECT_EQ(zero.joint, 2);
    EXPECT_TRUE(zero.may_be_heat);
    EXPECT_FALSE(zero.by_model_celsius);
    EXPECT_NEAR(zero.found_celsius.value(), 32.0, 1e-6);
    EXPECT_NEAR(zero.unmoved_celsius.value(), 20.0, 4.0);
  }
}

TEST(WarmedZero, ThatMovedBesidesIsNoHeat) {
  const ChangeReport report = checked_warm(cold_model(), 5e-3, 933);
  ASSERT_EQ(report.warmed.size(), 1U);
  EXPECT_FALSE(report.warmed.front().may_be_heat);
}

TEST(WarmedZero, IsHeldAgainstTheReferenceOfTheModel) {
  CalibratedModel model = cold_model();
  model.robot.effects = {
      {.kind = "thermal_offset", .joint = 2, .settings = {{"reference_celsius", 20.0}}, .values = {1e-5}}};
  const ChangeReport warmer = checked_warm(model, 0.0, 934), moved = checked_warm(model, 6e-4, 935);
  ASSERT_EQ(warmer.warmed.size(), 1U);
  EXPECT_EQ(warmer.warmed.front().by_model_celsius, 20.0);
  EXPECT_TRUE(warmer.warmed.front().may_be_heat);
  ASSERT_EQ(moved.warmed.size(), 1U);
  EXPECT_FALSE(moved.warmed.front().may_be_heat);
}

TEST(WarmedZero, CannotBeToldFromHeatWherePosesDoNotShowWhatTheTemperatureDoes) {
  CalibratedModel model = cold_model();
  CorrectedRobot now = true_wrist(1);
  now.chain.joints[2].theta_rad += 5e-3;
  DataSet data = measured_wrist(now, 15, 0, 936);
  const auto said = [&] {
    const ChangeReport report = find_change(model, data);
    EXPECT_FALSE(report.found.empty());
    return report.not_testable.empty() ? std::string() : report.not_testable.front();
  };
  EXPECT_EQ(said().find("heat"), std::string::npos) << "of a model without effects of the temperature";
  model.robot.effects = {
      {.kind = "thermal_offset", .joint = 2, .settings = {{"reference_celsius", 20.0}}, .values = {1e-5}}};
  EXPECT_EQ(said(), "The temperature was not recorded: heat cannot be told apart from the zeros that were found.");
  for (MeasuredPose& pose : data.poses) pose.temperature_celsius = 20.0;
  EXPECT_EQ(said(),
            "The temperature is the same at all poses: heat cannot be told apart from the zeros that were found.");
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    data.poses[i].temperature_celsius = 20.0 + static_cast<double>(i % 2);
  EXPECT_EQ(said().find("heat"), std::string::npos);
}

}  // namespace
}  // namespace demecal
