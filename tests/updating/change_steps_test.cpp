// Causes of a change are named where they really explain it, and not where they lower what they leave by little.
#include "updating/change_steps.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "kinematics/units.hpp"
#include "lacking_numbers.hpp"

namespace demecal {
namespace {

constexpr ExpectedErrors kExpected{1.5, 1e-4};

/// By strain, errors in proportion.
std::vector<ChangeStep> steps_of(const std::vector<double>& strains) {
  std::vector<ChangeStep> steps;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    ChangeStep step;
    step.strain = strains[i];
    step.strain_before = strains[i > 0 ? i - 1 : 0];
    step.left_m = strains[i] * kExpected.rms_m;
    steps.push_back(std::move(step));
  }
  return steps;
}

TEST(ChangeSteps, AreNamedWhereTheyLeaveWhatIsExpected) {
  EXPECT_EQ(named_step(steps_of({1.2}), kExpected), 0U);
  EXPECT_EQ(named_step(steps_of({1.2, 1.1}), kExpected), 1U);
  EXPECT_EQ(named_step(steps_of({30.0, 20.0, 1.1}), kExpected), 2U);
  EXPECT_EQ(named_step(steps_of({30.0, 1.6, 1.4}), kExpected), 2U);
}

TEST(ChangeSteps, AreNotNamedWhereTheyLeaveMostOfLargeErrors) {
  EXPECT_EQ(named_step(steps_of({30.0, 16.0}), kExpected), 0U);
  EXPECT_EQ(named_step(steps_of({30.0, 14.0}), kExpected), 1U);
  EXPECT_EQ(named_step(steps_of({3.0, 2.0}), kExpected), 1U);
}

TEST(ChangeSteps, AreNotNamedWhereTheyLowerWhatIsLeftByLessThanAQuarter) {
  EXPECT_EQ(named_step(steps_of({2.5, 2.3}), kExpected), 0U);
  EXPECT_EQ(named_step(steps_of({2.8, 1.9, 1.7}), kExpected), 1U);
  EXPECT_EQ(named_step(steps_of({3.0, 2.5, 1.6}), kExpected), 2U) << "one alone explains little of two";
}

TEST(ChangeSteps, AreNotNamedByStrainAloneWhereTheRobotErrsAsBefore) {
  std::vector<ChangeStep> steps = steps_of({30.0, 1.2});
  steps.back().left_m = 0.8 * steps.front().left_m;
  EXPECT_EQ(named_step(steps, kExpected), 0U);
  steps.front().orientation_rad = steps.back().orientation_rad = 1e-4;
  EXPECT_EQ(named_step(steps, kExpected), 1U) << "orientations show what positions do not";
}

TEST(ChangeSteps, ReallyLeaveLessWhereAtLeastHalfOfWhatWasPromisedComesTrue) {
  ChangeStep step;
  step.left.values = Eigen::VectorXd::Ones(10);
  step.strain_before = 10.0;
  step.left_m = 1e-4;
  step.strain = 2.0;
  EXPECT_TRUE(really_leaves_less(step, 1e-3));
  EXPECT_FALSE(really_leaves_less(step, 0.9e-4));
  step.strain = 8.0;
  EXPECT_FALSE(really_leaves_less(step, 1e-3));
}

TEST(ChangeSteps, OfALinkBentByLittleNameNothingThatLowersTheErrorsByLittle) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CalibratedModel model = model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
    for (const std::size_t link : {1, 2, 3, 4}) {
      CorrectedRobot now = true_wrist(seed);
      now.chain.joints[link].alpha_rad += radians(0.02);
      now.chain.joints[link].a_m += 1e-4;
      const ChangeReport report = find_change(model, measured_wrist(now, 14, 0, 700 + 10 * seed + link));
      if (report.more) {
        EXPECT_LT(report.left_m, 0.85 * report.error_m) << seed << ", link " << link + 1;
      }
    }
  }
}

}  // namespace
}  // namespace demecal
