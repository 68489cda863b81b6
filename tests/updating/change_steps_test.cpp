// Causes of a change are named where they really explain it.
#include "updating/change_steps.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

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

}  // namespace
}  // namespace demecal
