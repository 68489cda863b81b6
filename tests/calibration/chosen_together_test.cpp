// Corrections that joints learnt alone are chosen, and sized, beside each other.
#include "calibration/chosen_together.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "erring_arm.hpp"
#include "expression/text.hpp"
#include "prediction/measurement.hpp"

namespace demecal {
namespace {

/// Candidates of a joint, by their texts in rad; targets of 2 mrad.
JointCandidates offered(std::uint32_t joint, const std::vector<std::string>& texts) {
  JointCandidates result;
  result.training.joint = joint;
  result.training.range_rad = {-M_PI, M_PI};
  result.training.table.target = {0.002};
  result.training.table.weight = {1.0};
  for (const std::string& text : texts) result.front.push_back({parse(text), 0.0});
  return result;
}

/// What is chosen beside a fit of the declared numbers.
Selection choose(const DataSet& data, const std::vector<JointCandidates>& candidates) {
  Job job;
  job.declared = {.registration = true};
  const Preparation preparation = prepare(data, job);
  const Fit start = loop_start(data, preparation.declared, preparation.declared.robot);
  return choose_together(data, job.declared, poses_of(data, PoseSet::calibration), poses_of(data, PoseSet::validation),
                         start, candidates);
}

double rms_mm_after_refit(const DataSet& data, const CorrectedRobot& robot) {
  const DeclaredModel declared{.registration = true};
  const Fit again = fit_declared(data, poses_of(data, PoseSet::calibration), declared, robot, {});
  return error_figures(again.robot, data, poses_of(data, PoseSet::validation)).rms_mm;
}

TEST(ChosenTogether, GivesEveryCorrectionTheSizeThatSuitsTheOthers) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const DataSet data =
        measure(true_puma({"", "0.002*SIN(2*theta)", "0.0015*COS(2*theta)", "", "", ""}), 90, 5e-5, seed, false);
    const std::vector<JointCandidates> joints{offered(1, {"0.0001*theta", "0.0011*SIN(2*theta)"}),
                                              offered(2, {"0.003*COS(2*theta)", "0.0002*theta"})};
    const Selection selection = choose(data, joints);
    ASSERT_TRUE(selection.choices[0].kept && selection.choices[1].kept) << "seed " << seed;
    EXPECT_NEAR(selection.robot.corrections[1](0.6), 0.002 * std::sin(1.2), 1e-4) << "seed " << seed;
    EXPECT_NEAR(selection.robot.corrections[2](1.2), 0.0015 * std::cos(2.4), 1e-4) << "seed " << seed;
    EXPECT_LT(rms_mm_after_refit(data, selection.robot), 0.12) << "seed " << seed;
  }
}

TEST(ChosenTogether, KeepsNothingWhereTheArmDoesNotErr) {
  int kept = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const DataSet data = measure(true_puma({"", "", "", "", "", ""}), 90, 1e-4, seed, false);
    std::vector<JointCandidates> joints;
    for (std::uint32_t joint = 0; joint < 6; ++joint)
      joints.push_back(offered(joint, {"0.00002*SIN(theta)", "0.00003*COS(3*theta)", "0-0.00002*SIN(theta)"}));
    for (const JointChoice& choice : choose(data, joints).choices) kept += choice.kept ? 1 : 0;
  }
  EXPECT_LE(kept, 3) << "of 120 corrections, one false keep in forty";
}

TEST(ChosenTogether, TakesNothingThatGrowsBeyondTheLimitOrJumpsOften) {
  const DataSet data = measure(true_puma({"", "0.009*SIN(2*theta)", "", "", "", ""}), 90, 5e-5, 3, false);
  const std::vector<JointCandidates> too_large{offered(1, {"0.003*SIN(2*theta)"})};  // needs 9 mrad, of 6 allowed
  EXPECT_FALSE(choose(data, too_large).choices[0].kept);
  const DataSet square = measure(true_puma({"", "0.002*SIGN(SIN(9*theta))", "", "", "", ""}), 90, 5e-5, 3, false);
  const std::vector<JointCandidates> jumping{offered(1, {"0.002*SIGN(SIN(9*theta))"})};
  EXPECT_FALSE(choose(square, jumping).choices[0].kept);
}

TEST(ChosenTogether, LeavesOutWhatOnlyOneListOfPosesSupports) {
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), 90, 1e-4, 5, false);
  const DataSet erring = measure(true_puma({"", "0.001*SIN(2*theta)", "", "", "", ""}), 90, 1e-4, 5, false);
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    if (data.poses[i].set == PoseSet::calibration) data.poses[i] = erring.poses[i];
  EXPECT_FALSE(choose(data, {offered(1, {"0.001*SIN(2*theta)"})}).choices[0].kept);
}

}  // namespace
}  // namespace demecal
