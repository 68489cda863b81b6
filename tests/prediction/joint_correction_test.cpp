// A joint's correction: neutral by default, held beyond its range, one-valued across the branch, with its slope.
#include "prediction/corrected_robot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random_robot.hpp"

namespace demecal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Interval kRange{-1.0, 2.0};

TEST(JointCorrection, IsNeutralByDefaultAndFromTheNeutralTree) {
  for (const JointCorrection& neutral : {JointCorrection(), JointCorrection(neutral_tree(), {}, kRange)}) {
    EXPECT_TRUE(neutral.is_neutral());
    for (const double theta : {-7.0, 0.0, 0.3, 100.0}) {
      EXPECT_EQ(neutral(theta), 0.0);
      EXPECT_EQ(neutral.slope(theta), 0.0);
    }
  }
  EXPECT_FALSE(JointCorrection(constant_tree(0.0), {}, kRange).is_neutral());
}

TEST(JointCorrection, IsItsFormulaWithinTheRange) {
  const JointCorrection correction(wave(0.01, 2.0, 0.5), {}, kRange);
  RandomStream stream{501};
  for (int trial = 0; trial < 100; ++trial) {
    const double theta = stream.real(kRange.lower, kRange.upper);
    EXPECT_DOUBLE_EQ(correction(theta), 0.01 * std::sin(theta * 2.0 + 0.5));
  }
  EXPECT_EQ(correction.formula(), wave(0.01, 2.0, 0.5));
}

TEST(JointCorrection, KeepsTheValueOfTheNearerEndBeyondTheRange) {
  const JointCorrection correction(wave(0.01, 2.0, 0.5), {}, kRange);
  for (const double beyond : {1e-9, 0.5, 3.0}) {
    EXPECT_EQ(correction(kRange.upper + beyond), correction(kRange.upper));
    EXPECT_EQ(correction(kRange.lower - beyond), correction(kRange.lower));
    EXPECT_EQ(correction.slope(kRange.upper + beyond), 0.0);
    EXPECT_EQ(correction.slope(kRange.lower - beyond), 0.0);
  }
}

TEST(JointCorrection, SlopeIsItsDerivativeOnBothSidesOfTheEnds) {
  RandomStream stream{502};
  const double step = 1e-6;
  for (int trial = 0; trial < 500; ++trial) {
    const JointCorrection correction = random_correction(stream, 0.1, kRange);
    const double theta = stream.real(-2.0, 3.0);
    if (std::abs(theta - kRange.lower) < 2 * step || std::abs(theta - kRange.upper) < 2 * step) continue;
    EXPECT_NEAR(correction.slope(theta), (correction(theta + step) - correction(theta - step)) / (2 * step), 1e-9);
  }
}

TEST(JointCorrection, TakesTheBranchBeforeTheRange) {
  // Data from 2.6 to 4.0 rad, of a controller that reports the part beyond pi as negative angles.
  const AngleBranch branch{true, 3.3};
  const JointCorrection correction(variable_tree(0), branch, {2.6, 4.0});
  EXPECT_DOUBLE_EQ(correction(3.0), 3.0);
  EXPECT_DOUBLE_EQ(correction(-3.0), 2 * kPi - 3.0);
  EXPECT_DOUBLE_EQ(correction(-1.0), 4.0);  // beyond the end, by way of half a turn
  EXPECT_DOUBLE_EQ(correction(2.0), 2.6);
  EXPECT_EQ(correction.slope(-3.0), 1.0);
  EXPECT_EQ(correction.slope(-1.0), 0.0);
  EXPECT_NEAR(correction(kPi - 1e-9), correction(-kPi + 1e-9), 1e-8);
  EXPECT_TRUE(correction.branch().wraps);
  EXPECT_EQ(correction.range_rad().upper, 4.0);
}

}  // namespace
}  // namespace demecal
