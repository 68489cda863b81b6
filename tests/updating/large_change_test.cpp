// A large change is named alone and in its full size, since causes are taken into the robot before others are tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "kinematics/units.hpp"
#include "lacking_numbers.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal {
namespace {

CalibratedModel model_of_large(std::uint64_t seed) {
  return model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
}

std::string names_of(const ChangeReport& report) {
  std::string names;
  for (const ChangeCause& cause : report.found)
    names += cause.effect.kind + " of joint " + std::to_string(cause.effect.joint + 1) + ": " +
             std::to_string(cause.size) + "; ";
  return names;
}

TEST(LargeChange, OfAZeroIsNamedAloneAndInFull) {
  for (const int joint : {1, 2, 3, 4}) {
    for (const double turned_deg : {1.0, 3.0, 10.0}) {
      CorrectedRobot now = true_wrist(1);
      now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += radians(turned_deg);
      const ChangeReport report = find_change(model_of_large(1), measured_wrist(now, 14, 0, 900));
      EXPECT_EQ(report.verdict, ChangeVerdict::changed);
      EXPECT_FALSE(report.set_up_anew);
      ASSERT_EQ(report.found.size(), 1U) << joint << ", " << turned_deg << " deg: " << names_of(report);
      EXPECT_EQ(report.found.front().effect.joint, joint);
      EXPECT_EQ(declared_flag(report.found.front().effect.kind), &DeclaredModel::joint_offset);
      EXPECT_NEAR(report.found.front().size, radians(turned_deg), 4.0 * report.found.front().standard_error);
      EXPECT_FALSE(report.more);
      EXPECT_LT(report.left_m, 1.5e-4);
    }
  }
}

TEST(LargeChange, OfTheToolIsNamedAloneAndInFull) {
  CorrectedRobot now = true_wrist(2);
  now.tools.at("").translation() += Eigen::Vector3d(30e-3, -10e-3, 0.0);
  const ChangeReport report = find_change(model_of_large(2), measured_wrist(now, 14, 0, 901));
  ASSERT_EQ(report.found.size(), 1U) << names_of(report);
  EXPECT_EQ(declared_flag(report.found.front().effect.kind), &DeclaredModel::tool);
  EXPECT_NEAR(report.found.front().effect.values[0], 30e-3, 1e-4);
  EXPECT_NEAR(report.found.front().effect.values[1], -10e-3, 1e-4);
}

TEST(LargeChange, BesideABaseThatStandsElsewhereIsNamedAlone) {
  CorrectedRobot now = true_wrist(1);
  now.sensor_from_base.translation() += Eigen::Vector3d(0.5, 0.2, 0.1);
  now.chain.joints[2].theta_rad += radians(3.0);
  const ChangeReport report = find_change(model_of_large(1), measured_wrist(now, 14, 0, 902));
  EXPECT_TRUE(report.set_up_anew);
  ASSERT_FALSE(report.found.empty());
  for (const ChangeCause& cause : report.found)
    EXPECT_TRUE(cause.is_registration || (cause.effect.joint == 2 && cause.effect.kind == "joint_offset"))
        << names_of(report);
}

TEST(LargeChange, OfAZeroBesideABaseThatMovedALittleIsNamedWithIt) {
  for (const int joint : {1, 2, 3}) {
    CorrectedRobot now = true_wrist(1);
    now.sensor_from_base.translation() += Eigen::Vector3d(3e-3, -2e-3, 1e-3);
    now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += radians(10.0);
    const ChangeReport report = find_change(model_of_large(1), measured_wrist(now, 14, 0, 903));
    EXPECT_EQ(report.verdict, ChangeVerdict::changed);
    EXPECT_FALSE(report.unnamed || report.more) << names_of(report);
    for (const ChangeCause& cause : report.found)
      if (!cause.is_registration) {
        EXPECT_EQ(cause.effect.kind, "joint_offset") << names_of(report);
        EXPECT_EQ(cause.effect.joint, joint) << names_of(report);
        EXPECT_NEAR(cause.size, radians(10.0), 4.0 * cause.standard_error) << names_of(report);
      }
    EXPECT_TRUE(std::ranges::any_of(report.found, [](const ChangeCause& cause) { return !cause.is_registration; }));
  }
}

}  // namespace
}  // namespace demecal
