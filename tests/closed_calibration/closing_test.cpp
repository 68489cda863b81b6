// The loop's model becomes a calibration with all its figures, and one found before can be taken up again.
#include "closed_calibration/closing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "expression/bound.hpp"
#include "lacking_arm.hpp"

namespace demecal {
namespace {

LoopResult looped(const DataSet& data, const Job& job, const Preparation& preparation) {
  LoopResult found = close_loop(data, job.declared, loop_start(data, preparation.declared, preparation.declared.robot),
                                loop_options(job));
  drop_negligible_terms(found.model);
  return found;
}

TEST(Closing, TheLoopStartsWithTheScatterOfItsRobot) {
  const DataSet data = lacking_arm(0.0, 1);
  const Preparation preparation = prepare(data, looping_job());
  CorrectedRobot off = preparation.declared.robot;
  off.sensor_from_base.translation().array() += 0.01;
  const Fit near = loop_start(data, preparation.declared, preparation.declared.robot);
  const Fit far = loop_start(data, preparation.declared, off);
  EXPECT_GT(far.sigma_position_m, 3.0 * near.sigma_position_m);
  EXPECT_EQ(far.sigma_orientation_rad, 0.0);
  EXPECT_EQ(far.sigma_distance_m, 0.0);
}

TEST(Closing, StartsWithoutCorrectionsThatSmoothTermsCannotMakeGood) {
  const DataSet data = lacking_arm(0.0, 6);
  const Job job = looping_job();
  const Fit declared = prepare(data, job).declared;
  CorrectedRobot rough = declared.robot;
  rough.corrections[0] = {parse("0.0008*SIN(theta)+0.0005*SIN(41*theta)"), {}, {-1.3, 1.3}};
  const auto started = [&](const CorrectedRobot& robot, const DeclaredModel& model) {
    return better_start(data, model, declared, robot);
  };
  EXPECT_FALSE(has_corrections(started(rough, job.declared)));
  EXPECT_TRUE(has_corrections(started(rough, {.registration = true}))) << "nothing else could take its place";
}

TEST(Closing, GivesDeclaredNumbersTheirStandardErrors) {
  const DataSet data = lacking_arm(6e-4, 2);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  const LoopResult found = looped(data, job, preparation);
  const Calibration calibration = calibration_of(data, job.declared, preparation, found.model);
  ASSERT_EQ(calibration.estimates.size(), 6U);
  for (const ParameterEstimate& estimate : calibration.estimates) {
    EXPECT_GT(estimate.standard_error, 0.0) << estimate.id.name();
    EXPECT_NEAR(estimate.value, 0.0, 2e-3) << estimate.id.name();  // the data's frame is the base's
  }
  EXPECT_LT(calibration.index_after_mm2, calibration.index_before_mm2);
}

TEST(Closing, JudgesTheBestModelByPosesItHadNotSeenAsItDoesTheChosenOne) {
  DataSet data = lacking_arm(6e-4, 2);
  for (std::size_t i = 0; i < data.poses.size(); i += 4) data.poses[i].set = PoseSet::accept;
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  const LoopResult found = looped(data, job, preparation);
  const auto last = last_fit(data, job.declared, preparation, {found.before, found.model});
  const auto best = calibration_of_best(data, job.declared, preparation, found.before.robot, found.model);
  ASSERT_TRUE(last && best && best->unseen);
  EXPECT_EQ(best->unseen->before_mm, last->unseen.before_mm);
  EXPECT_EQ(best->unseen->after_mm, last->unseen.after_mm);
  EXPECT_EQ(best->unseen->interval.quantile, last->unseen.interval.quantile);
  EXPECT_NE(error_figures(best->robot, data, poses_of(data, PoseSet::validation)).rms_mm, best->unseen->after_mm);
}

TEST(Closing, HoldsCorrectionsWithinTheLimitOfTheirJoint) {
  const DataSet data = lacking_arm(0.0, 4);
  Job job = looping_job();
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const auto over_limit = [&](const DiagnosedModel& model, const Preparation& preparation) {
    double most = 0.0;
    const JointTargets targets = targets_about(data, preparation, model.robot);
    for (const JointTraining& training : training_tables(model.robot.chain, targets, preparation.corrections)) {
      const JointCorrection& correction = model.robot.corrections[training.joint];
      const double bound_rad = magnitude_bound(correction.formula(), correction.range_rad());
      most = std::max(most, bound_rad / correction_limit_rad(training));
    }
    return most;
  };
  const Preparation free = prepare(data, job);
  DiagnosedModel model = looped(data, job, free).model;
  ASSERT_LT(over_limit(model, free), 1.0);
  EXPECT_EQ(with_bounded_corrections(data, job.declared, free, poses, model).precision.size(), 0)
      << "nothing is believed anew where all joints are within";
  job.corrections.largest_rad = 4e-4;  // of .8 mrad that joint 1 errs by
  const Preparation limited = prepare(data, job);
  ASSERT_GT(over_limit(model, limited), 1.5);
  const double before_mm = error_figures(model.robot, data, poses).rms_mm;
  model = with_bounded_corrections(data, job.declared, limited, poses, model);
  EXPECT_LT(over_limit(model, limited), 1.001);
  EXPECT_GT(over_limit(model, limited), 0.4) << "the correction is held back, not dropped";
  EXPECT_GT(error_figures(model.robot, data, poses).rms_mm, before_mm);
  const Calibration held = calibration_of(data, job.declared, limited, model);
  EXPECT_NEAR(held.joints.front().limit_rad.value_or(0.0), 4e-4, 1e-12) << "which a person is told";
  EXPECT_FALSE(held.joints[1].limit_rad);
}

TEST(Closing, SummarisesTheJointsOfTheLoopsModel) {
  const DataSet data = lacking_arm(6e-4, 3);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  const Calibration calibration = calibration_of(data, job.declared, preparation, looped(data, job, preparation).model);
  ASSERT_EQ(calibration.joints.size(), 6U);
  const JointSummary& first = calibration.joints[0];
  EXPECT_TRUE(first.kept);
  EXPECT_LT(first.after_rad, first.before_rad);
  EXPECT_GT(first.bound_rad, 4e-4);
  for (const JointSummary& joint : calibration.joints) EXPECT_EQ(joint.kept, joint.note.empty());
}

TEST(Closing, TellsSumsOfSmoothTermsFromFormulasThatEvolved) {
  const DataSet data = lacking_arm(6e-4, 3);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  DiagnosedModel model = looped(data, job, preparation).model;
  Calibration calibration = calibration_of(data, job.declared, preparation, model);
  ASSERT_TRUE(calibration.joints[0].kept);
  EXPECT_EQ(calibration.joints[0].origin, FormulaOrigin::smooth_terms);
  model.smooth.base[0] = {parse("0.0008*SIN(theta)"), {}, {-1.3, 1.3}};
  EXPECT_EQ(calibration_of(data, job.declared, preparation, model).joints[0].origin, FormulaOrigin::unstated);
  std::vector<JointSummary> start = calibration.joints;
  start[0].origin = FormulaOrigin::evolved;
  set_origins(model, start, calibration);
  EXPECT_EQ(calibration.joints[0].origin, FormulaOrigin::evolved_and_smooth_terms);
  model.smooth.coefficients.setZero();
  set_origins(model, start, calibration);
  EXPECT_EQ(calibration.joints[0].origin, FormulaOrigin::evolved);
}

TEST(Closing, TidyMovesNothingThatCouldBeMeasured) {
  const DataSet data = lacking_arm(6e-4, 4);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  LoopResult found = close_loop(data, job.declared, loop_start(data, preparation.declared, preparation.declared.robot),
                                loop_options(job));
  const CorrectedRobot before = found.model.robot;
  drop_negligible_terms(found.model);
  for (const MeasuredPose& pose : data.poses) {
    const Stop stop(pose);
    EXPECT_LT((before.predict(stop, "").translation() - found.model.robot.predict(stop, "").translation()).norm(),
              1e-6);
  }
}

TEST(Closing, TheLoopIsGivenWhatTheJobAllows) {
  Job job;
  job.seed = 7;
  job.closed_loop = {
      .max_effects = 4, .family_error = 0.01, .candidates = {"backlash"}, .highest_ratio = 30, .ratios = {211.0}};
  const LoopOptions options = loop_options(job, 3);
  EXPECT_EQ(options.max_effects, 7);
  EXPECT_EQ(options.family_error, 0.01);
  EXPECT_EQ(options.kinds, std::vector<std::string>{"backlash"});
  EXPECT_EQ(options.highest_ratio, 30);
  EXPECT_EQ(options.stated_ratios, std::vector<double>{211.0});
  EXPECT_EQ(options.seed, 7U);
}

TEST(PrepareFrom, TakesAModelUpInAnotherFrameWithItsCorrectionsAndEffects) {
  const DataSet data = lacking_arm(6e-4, 5);
  const Job job = looping_job();
  const Preparation preparation = prepare(data, job);
  const CorrectedRobot model = looped(data, job, preparation).model.robot;
  ASSERT_FALSE(model.effects.empty());
  DataSet moved = data;
  moved.frame = Frame::sensor;
  const Eigen::Isometry3d there =
      Eigen::Translation3d(2.0, -1.0, 0.5) * Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized());
  for (MeasuredPose& pose : moved.poses) pose.position_m = there * *pose.position_m;
  const Preparation again = prepare_from(moved, job.declared, model);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::validation);
  EXPECT_EQ(again.declared.robot.effects.size(), model.effects.size());
  EXPECT_EQ(again.declared.robot.corrections[0].formula(), model.corrections[0].formula());
  EXPECT_NEAR(error_figures(again.declared.robot, moved, poses).rms_mm, error_figures(model, data, poses).rms_mm, 0.01);
}

}  // namespace
}  // namespace demecal
