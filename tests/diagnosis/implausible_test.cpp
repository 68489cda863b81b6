// What is larger than any real arm's error: named for what it is, and no bound of anything.
#include "diagnosis/implausible.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulated_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// Measured by a controller that reports joint 3 against the horizontal: its true angle is q3 + sign q2.
DataSet reported_against_horizontal(double sign, std::uint64_t seed) {
  Scenario scenario = perfect_scenario(parallel_arm(), seed);
  DataSet data = simulate(scenario);
  for (MeasuredPose& pose : data.poses) pose.joints[2] -= sign * pose.joints[1];
  return data;
}

TEST(UnitCoupling, IsNamedAndNoBound) {
  for (const double sign : {1.0, -1.0}) {
    const DataSet data = reported_against_horizontal(sign, 71);
    const LoopOutcome outcome = run_loop(data, kZeroed, quick()).outcome;
    const auto coupling = std::ranges::find_if(
        outcome.rounds, [](const Round& round) { return round.reason.starts_with("the data show a unit coupling"); });
    ASSERT_NE(coupling, outcome.rounds.end()) << sign;
    EXPECT_TRUE(coupling->implausible);
    EXPECT_THAT(coupling->reason,
                HasSubstr("joint 3 turns with joint 2, by " + std::string(sign > 0 ? "1.000" : "-1.000")));
    EXPECT_THAT(coupling->reason, HasSubstr(sign > 0 ? "write its column as q3 + q2" : "write its column as q3 - q2"));
    for (const NotFound& missing : outcome.not_found) {
      const bool it = missing.effect.same_law_as(coupling->effect);
      EXPECT_FALSE(it) << "what the data hold is not bounded";
      if (missing.effect.kind != "coupling" || missing.unit != "1" || !missing.testable) continue;
      EXPECT_LT(missing.smallest_detectable, 0.05);
    }
  }
}

TEST(Limits, AreTestableInGoodDataAndNotWhereTheErrorIsHuge) {
  const DataSet good = simulate(perfect_scenario(parallel_arm(), 72));
  const LoopOutcome clean = run_loop(good, kZeroed, quick()).outcome;
  const auto tested = [](const LoopOutcome& outcome, const char* kind) {
    return std::ranges::count_if(
        outcome.not_found, [kind](const NotFound& missing) { return missing.effect.kind == kind && missing.testable; });
  };
  EXPECT_GE(tested(clean, "backlash"), 5);
  DataSet bad = good;  // a different error at every pose, of a third of a metre
  RandomStream random{72, 1};
  for (MeasuredPose& pose : bad.poses)
    *pose.position_m += 0.3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  const LoopOutcome loud = run_loop(bad, kZeroed, quick()).outcome;
  EXPECT_EQ(tested(loud, "backlash"), 0);
  EXPECT_FALSE(loud.not_found.empty());
}

}  // namespace
}  // namespace demecal
