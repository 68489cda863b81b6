// An effect needs its law and its line of the catalogue: with these alone it is found, fitted, reported, saved, read
// and corrected. The catalogue of this program has one line more than the product's (tests/CMakeLists.txt).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "effects/catalogue.hpp"
#include "library/demecal.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kDegrees = 57.29577951308232;

ArmDescription arm_with_hoses() {
  ArmDescription description;
  description.name = "hoses";
  for (const ArmLink& link : {ArmLink{.alpha_deg = -90, .d_mm = 300}, ArmLink{.a_mm = 500}, ArmLink{.a_mm = 400}})
    description.links.push_back(link);
  description.tool_mm = {20, 0, 30};
  return description;
}

/// Positions of that arm in its base's frame, its third joint pulled by `per_rad` times the square of the second.
Measurements measured(double per_rad) {
  const Arm arm(arm_with_hoses());
  std::vector<PoseMeasurement> poses;
  for (int i = 0; i < 90; ++i) {
    const double turn = 2.4 * i;
    PoseMeasurement pose;
    pose.command.joints = {100 * std::sin(turn), 60 * std::cos(1.7 * turn), 80 * std::sin(0.6 * turn + 1)};
    std::vector<double> real = pose.command.joints;
    real[2] += kDegrees * per_rad * std::pow(real[1] / kDegrees, 2);
    pose.position_mm = arm.pose(real).position_mm;
    for (int axis = 0; axis < 3; ++axis)
      pose.position_mm[static_cast<std::size_t>(axis)] += 0.02 * std::sin(91.0 * i + 40.0 * axis);
    if (i % 3 == 2)
      pose.use = i % 2 == 0 ? PoseUse::validation : PoseUse::accept;
    else
      pose.use = PoseUse::calibration;
    poses.push_back(pose);
  }
  return Measurements(arm, poses, true);
}

CalibrationSettings without_corrections() {
  CalibrationSettings settings;
  settings.declared = {"registration", "joint_offset"};
  return settings;
}

TEST(MadeUpEffect, IsOfTheCatalogue) {
  ASSERT_NE(find_law("hose_pull"), nullptr);
  EXPECT_EQ(cause_of("hose_pull").words, "the pull of hoses");
}

TEST(MadeUpEffect, IsFoundSavedReadAndCorrected) {
  const Measurements poses = measured(1.5e-3);
  const CalibratedArm found = calibrate(poses, without_corrections());
  ASSERT_EQ(found.effects().size(), 1u);
  EXPECT_EQ(found.effects()[0].kind, "hose_pull");
  EXPECT_EQ(found.effects()[0].joint, 3);
  EXPECT_THAT(found.effects()[0].sentence, HasSubstr("Hoses pull Joint 3"));
  EXPECT_LT(found.errors(poses, PoseUse::accept).rms_mm, 0.05);

  const std::string file = std::filesystem::path(::testing::TempDir()) / "made_up_effect_model.yaml";
  found.save(file);
  const CalibratedArm read = CalibratedArm::load(file);
  const JointCommand command{{20, 50, -30}};
  EXPECT_EQ(read.predict(command).position_mm, found.predict(command).position_mm);
  const std::vector<double> sent = read.correct(command);
  EXPECT_NEAR(sent[2] - command.joints[2], -kDegrees * 1.5e-3 * std::pow(50 / kDegrees, 2), 0.01);
}

TEST(MadeUpEffect, IsNotFoundWhereNothingPulls) {
  EXPECT_THAT(calibrate(measured(0.0), without_corrections()).effects(), IsEmpty());
}

}  // namespace
}  // namespace demecal
