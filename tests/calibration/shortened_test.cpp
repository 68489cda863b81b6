// Reported corrections keep their values, and are shorter.
#include "calibration/shortened.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/text.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(Shortened, KeepsEveryValueInTheRange) {
  const std::vector<const char*> formulas{
      "0.001 * (theta + (theta - 0.9) + SQRTp(theta + theta)) + (0.0002 * 1 + 0.0003 * (1.5 * (2.1 * (theta - 0.6)) * "
      "(2.1 * (theta - 0.6)) + (-0.5)))",
      "0.002 * (theta % theta + 0.5 * SIN(theta) + 0.25 * SIN(theta)) - 0.001",
      "0.001 * SIGN(theta + 1 - theta) * COS(2 * theta + theta)", "0.001 * ((3 * theta) % theta + 2 % (theta + 4))"};
  RandomStream random{41};
  for (const char* text : formulas) {
    const JointCorrection correction(parse(text), {}, {-2.0, 1.5});
    const JointCorrection brief = shortened(correction);
    EXPECT_LE(brief.formula().size(), correction.formula().size()) << text;
    for (int trial = 0; trial < 1000; ++trial) {
      const double theta_rad = trial == 0 ? 0.0 : random.real(-3.0, 3.0);
      EXPECT_NEAR(brief(theta_rad), correction(theta_rad), 1e-11) << text;
    }
  }
}

TEST(Shortened, IsShorterWhereTermsCanBeCollected) {
  const JointCorrection correction(parse("0.25 * (theta + (theta - 0.5) + 1 * theta)"), {}, {-2.0, 1.5});
  EXPECT_EQ(to_string(shortened(correction).formula()), "0.75 * theta - 0.125");
}

TEST(Shortened, LeavesNeutralCorrectionsNeutral) {
  EXPECT_TRUE(shortened(JointCorrection{}).is_neutral());
  EXPECT_TRUE(shortened({neutral_tree(), {}, {-1.0, 1.0}}).is_neutral());
}

}  // namespace
}  // namespace demecal
