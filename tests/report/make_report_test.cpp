// The figures of a report that are computed from the data themselves.
#include "report/make_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <tuple>

#include "expression/text.hpp"
#include "fitting/known_arm.hpp"
#include "prediction/measurement.hpp"
#include "random/random_stream.hpp"
#include "report/figures.hpp"
#include "residuals/structure.hpp"

namespace demecal {
namespace {

/// Poses that repeat `repeats` times with noise of `sigma_m` on each axis.
DataSet repeated(int poses, int repeats, double sigma_m) {
  RandomStream random{461};
  DataSet data;
  for (int pose = 0; pose < poses; ++pose) {
    const Eigen::Vector3d place(random.real(-1.0, 1.0), random.real(-1.0, 1.0), random.real());
    for (int repeat = 0; repeat < repeats; ++repeat) {
      MeasuredPose measured;
      measured.pose_id = "P" + std::to_string(pose);
      measured.position_m = place + sigma_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      data.poses.push_back(measured);
    }
  }
  return data;
}

/// What a run leaves that fits the true arm to poses of all sets with 0.05 mm of noise.
struct PerfectRun {
  KnownArm arm = perfect_arm(parallel_arm(), Frame::base);
  CalibratedModel model;
  Preparation preparation;
  LoopOutcome loop;
  Calibration calibration;
  DataCheck check;
  std::vector<JointCandidates> candidates;
  std::vector<DistalStep> distal;
  std::vector<FoundTransform> structure;
  RunFacts facts;

  PerfectRun() {
    RandomStream random{462};
    measure(arm, random, {.noise_m = 5e-5}, 90);
    for (std::size_t i = 0; i < 90; ++i) {
      arm.data.poses[i].set = static_cast<PoseSet>(i % 3);
      arm.data.poses[i].pose_id = "P" + std::to_string(i);
    }
    model.nominal = arm.data.robot;
    model.robot = preparation.nominal = preparation.registered.robot = preparation.declared.robot = arm.truth;
    model.joints.clear();
  }
  Report report() const {
    return make_report(
        {arm.data, model, arm.truth, loop, preparation, calibration, check, candidates, distal, structure, facts});
  }
};

TEST(Corrections, AreSaidToBeFromWhereTheCalibrationHasThemFrom) {
  PerfectRun run;
  run.model.robot.corrections[0] = {parse("0.001 * SIN(theta)"), {}, {-1.0, 1.0}};
  run.model.joints = {{.joint = 0, .kept = true, .note = {}}, {.joint = 1, .kept = false, .note = {}}};
  run.model.method = Method::direct;
  run.calibration.joints = run.model.joints;
  run.calibration.joints[0].origin = FormulaOrigin::smooth_terms;
  const Report report = run.report();
  ASSERT_EQ(report.joints.size(), 2U);
  EXPECT_EQ(report.joints[0].origin, "smooth_terms");
  EXPECT_EQ(report.joints[1].origin, "");
}

TEST(Outliers, AreNamedInEverySetAndErrorsAreToldWithAndWithoutThem) {
  PerfectRun run;
  EXPECT_TRUE(run.report().poses.outliers.empty());
  EXPECT_EQ(outliers_sentence(run.report()), "");
  for (const std::size_t pose : {30U, 31U, 32U, 35U})
    *run.arm.data.poses[pose].position_m += Eigen::Vector3d(0, 2e-3, 0);
  const Report report = run.report();
  EXPECT_EQ(report.poses.outliers, (std::vector<std::string>{"P30", "P31", "P32", "P35"}));
  const std::string sentence = outliers_sentence(report);
  for (const auto& [set, name, left_out] :
       {std::tuple{PoseSet::calibration, "calibration", 1}, std::tuple{PoseSet::validation, "validation", 1},
        std::tuple{PoseSet::accept, "accept", 2}}) {
    std::vector<std::size_t> poses = poses_of(run.arm.data, set);
    const double with_mm = error_figures(run.arm.truth, run.arm.data, poses).rms_mm;
    std::erase_if(poses, [](std::size_t pose) { return pose >= 30 && pose <= 35 && pose != 33 && pose != 34; });
    const double without_mm = error_figures(run.arm.truth, run.arm.data, poses).rms_mm;
    EXPECT_LT(without_mm, 0.3 * with_mm);
    char expected[100];
    std::snprintf(expected, sizeof expected, "%.3f mm instead of %.3f mm on %s poses (%d left out)", without_mm,
                  with_mm, name, left_out);
    EXPECT_NE(sentence.find(expected), std::string::npos) << expected << "\n" << sentence;
  }
}

TEST(NoiseFloor, IsTheStandardDeviationOfRepeatsPerAxis) {
  // 2400 degrees of freedom: the estimate's own standard deviation is 1.4 %.
  EXPECT_NEAR(*noise_floor_mm(repeated(400, 3, 5e-5)), 0.05, 0.05 * 0.06);
  EXPECT_NEAR(*noise_floor_mm(repeated(4, 2, 0.0)), 0.0, 1e-12);
}

TEST(NoiseFloor, IsOfTheRepeatsOfAllSetsWhateverTheLoopSays) {
  DataSet data = repeated(40, 3, 5e-5);
  for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].set = static_cast<PoseSet>(i / 3 % 3);
  const double floor_mm = *noise_floor_mm(data);
  for (MeasuredPose& pose : data.poses) pose.set = PoseSet::calibration;
  EXPECT_EQ(*noise_floor_mm(data), floor_mm);
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_NEAR(floor_mm, 1e3 * pure_error(data, all)->deviation_m, 1e-15);
}

TEST(NoiseFloor, IsUnknownWithoutRepeats) {
  EXPECT_EQ(noise_floor_mm(repeated(50, 1, 5e-5)), std::nullopt);
  EXPECT_EQ(noise_floor_mm(DataSet{}), std::nullopt);
}

TEST(NoiseFloor, DoesNotTakeDifferentTargetsForRepeats) {
  DataSet data = repeated(2, 2, 5e-5);
  for (std::size_t i = 0; i < data.poses.size(); ++i) data.poses[i].target = i % 2 == 0 ? "A" : "B";
  EXPECT_EQ(noise_floor_mm(data), std::nullopt);
}

TEST(ErrorStages, NameNoBaseWhereNothingTellsWhereTheArmStands) {
  for (const bool touched : {false, true}) {
    Report report;
    report.nominal.calibration.mean_mm = 1.0;
    report.registered.calibration.mean_mm = 0.5;
    if (touched) report.contacts.emplace_back();
    report.workspace_error = WorkspaceEntry{0.1, 0.2, touched};
    const std::vector<Stage> stages = error_stages(report);
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0].title, touched ? "as described" : "before registration (instrument frame)");
    EXPECT_EQ(stages[1].title, touched ? "tool fitted" : "base fitted");
  }
}

TEST(ErrorStages, NameNoBaseWhereNoneIsDeclared) {
  Report report;
  report.nominal.calibration.mean_mm = 1.0;
  report.registered.calibration.mean_mm = 0.5;
  report.parameters = {{"tool_x_mm", 0.0, 1.0, 0.1}};
  const std::vector<Stage> with_tool = error_stages(report);
  ASSERT_EQ(with_tool.size(), 2u);
  EXPECT_EQ(with_tool[0].title, "as described");
  EXPECT_EQ(with_tool[1].title, "tool fitted");
  report.parameters.push_back({"base_x_mm", 0.0, 1.0, 0.1});
  EXPECT_EQ(error_stages(report)[1].title, "base fitted");
  report.parameters.clear();
  report.registered = report.nominal;
  const std::vector<Stage> with_nothing = error_stages(report);
  ASSERT_EQ(with_nothing.size(), 1u) << "a row of what was not fitted";
  EXPECT_EQ(with_nothing[0].title, "as described");
}

}  // namespace
}  // namespace demecal
