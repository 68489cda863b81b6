#include "closed_calibration/closing.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/admissible.hpp"
#include "calibration/joint_targets.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "diagnosis/loop.hpp"
#include "effect_sets/set_island.hpp"
#include "kinematics/chain.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline closed_calibration {
namespace {

constexpr double kSmallestCoefficient = 1e-8;  ///< rad

/// The declared numbers of the model with their standard errors; effects bring their own.
std::vector<ParameterEstimate> declared_estimates(const DataSet& data, const DeclaredModel& declared,
                                                  const DiagnosedModel& model) {
  const Linearization linearization = linearize({data, declared, poses_of_last_fit(data), {}}, model);
  const ParameterSpace space(with_contacts_of(model.robot, linearization.ids, data), linearization.ids);
  const Eigen::MatrixXd to_values = value_jacobian(space, space.at(Eigen::VectorXd::Zero(space.size())));
  const Eigen::MatrixXd covariance =
      to_values * linearization.covariance.topLeftCorner(space.size(), space.size()) * to_values.transpose();
  const CorrectedRobot nominal = nominal_robot(data);
  std::vector<ParameterEstimate> estimates;
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    if (id.kind == ParameterId::Kind::effect || id.kind == ParameterId::Kind::contact) continue;
    estimates.push_back({id, parameter_value(nominal, id), parameter_value(model.robot, id),
                         std::sqrt(std::max(0.0, covariance(i, i)))});
  }
  return estimates;
}

/// What the validation poses, which neither robot has seen yet, show of them.
UnseenValidation unseen_validation(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& before,
                                   const CorrectedRobot& after) {
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  const FittedPosterior fitted = fitted_posterior(data, declared, after, poses_of(data, PoseSet::calibration));
  return {.before_mm = error_figures(before, data, validation).rms_mm,
          .after_mm = error_figures(after, data, validation).rms_mm,
          .interval = prediction_interval(data, fitted, after),
          .noise = fitted.noise};
}

/// Whether the last fit takes in poses that others did not.
bool sees_more_at_last(const DataSet& data) {
  return poses_of_last_fit(data) != poses_of(data, PoseSet::calibration);
}

/// Per joint 0, or the limit that its correction may exceed.
std::vector<double> limits_exceeded(const DataSet& data, const Preparation& preparation, const CorrectedRobot& robot) {
  std::vector<double> exceeded_rad(robot.corrections.size(), 0.0);
  const JointTargets targets = targets_about(data, preparation, robot);
  for (const JointTraining& training : training_tables(robot.chain, targets, preparation.corrections)) {
    const JointCorrection& correction = robot.corrections[training.joint];
    if (!correction.is_neutral() && !is_bounded(correction, training))
      exceeded_rad[training.joint] = correction_limit_rad(training);
  }
  return exceeded_rad;
}

std::string why_uncorrected(const DeclaredModel& declared, const Joint& joint) {
  if (!declared.joint_corrections) return "joint corrections are not declared";
  if (!is_revolute(joint)) return "a prismatic joint";
  return "no correction earned its place, or the joint hardly moves";
}

}  // namespace

LoopOptions loop_options(const Job& job, std::size_t held) {
  LoopOptions options;
  options.kinds = job.closed_loop.candidates;
  options.max_effects = job.closed_loop.max_effects + static_cast<int>(held);
  options.family_error = job.closed_loop.family_error;
  options.highest_ratio = job.closed_loop.highest_ratio;
  options.stated_ratios = job.closed_loop.ratios;
  options.explanations = job.explanations;
  options.seed = job.seed;
  return options;
}

CorrectedRobot better_start(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                            const CorrectedRobot& robot) {
  constexpr int kSteps = 12;
  if (!declared.joint_corrections || !has_corrections(robot)) return robot;
  const DiagnosisProblem problem{data, declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  const std::vector<std::size_t> poses = selection_poses(data, fit.robot);
  const auto index_mm2 = [&](const CorrectedRobot& start) {
    const DiagnosedModel model = diagnosed_model(problem, loop_start(data, fit, start));
    return performance_index_mm2(refined(problem, model, kSteps).robot, data, poses);
  };
  CorrectedRobot bare = without_corrections(robot);
  return index_mm2(bare) < index_mm2(robot) ? bare : robot;
}

void drop_negligible_terms(DiagnosedModel& model) {
  for (double& coefficient : model.smooth.coefficients) {
    if (std::abs(coefficient) < kSmallestCoefficient) coefficient = 0.0;
  }
  model.robot.corrections = model.smooth.corrections();
}

DiagnosedModel with_bounded_corrections(const DataSet& data, const DeclaredModel& declared,
                                        const Preparation& preparation, const std::vector<std::size_t>& poses,
                                        DiagnosedModel model) {
  constexpr int kRounds = 10, kSteps = 3;
  constexpr double kFirmer = 2.0;
  const DiagnosisProblem problem{data, declared, poses, {}};
  for (int round = 0; !model.smooth.terms.empty() && round < kRounds; ++round) {
    const std::vector<double> exceeded_rad = limits_exceeded(data, preparation, model.robot);
    if (std::ranges::none_of(exceeded_rad, [](double limit) { return limit > 0.0; })) break;
    if (model.precision.size() == 0)
      model.precision = linearize(problem, model).precision.tail(model.smooth.coefficients.size());
    for (std::size_t i = 0; i < model.smooth.terms.size(); ++i) {
      const double limit = exceeded_rad[static_cast<std::size_t>(model.smooth.terms[i].joint)];
      double& precision = model.precision[static_cast<Eigen::Index>(i)];
      if (limit > 0.0) precision = kFirmer * std::max(precision, 1.0 / limit);
    }
    model.held_rad.resize(exceeded_rad.size());
    for (std::size_t joint = 0; joint < exceeded_rad.size(); ++joint)
      if (exceeded_rad[joint] > 0.0) model.held_rad[joint] = exceeded_rad[joint];
    model = refined(problem, std::move(model), kSteps);
  }
  drop_negligible_terms(model);
  return model;
}

Calibration calibration_of(const DataSet& data, const DeclaredModel& declared, const Preparation& preparation,
                           const DiagnosedModel& model) {
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  Calibration result{.robot = without_negligible_corrections(data, with_shortened_corrections(model.robot)),
                     .estimates = declared_estimates(data, declared, model),
                     .joints = {},
                     .unseen = {}};
  JointTargets now;
  if (has_corrections(result.robot)) now = targets_about(data, preparation, result.robot);
  result.joints = joint_summaries(preparation.targets, now, result.robot);
  for (JointSummary& summary : result.joints) {
    const auto joint = static_cast<std::size_t>(summary.joint);
    if (summary.kept && joint < model.held_rad.size() && model.held_rad[joint] > 0.0)
      summary.limit_rad = model.held_rad[joint];
    if (summary.kept) continue;
    summary.note = why_uncorrected(declared, data.robot.chain.joints[joint]);
  }
  set_origins(model, {}, result);
  result.index_before_mm2 = performance_index_mm2(preparation.declared.robot, data, fitted);
  result.index_after_mm2 = performance_index_mm2(result.robot, data, fitted);
  return result;
}

void set_origins(const DiagnosedModel& model, const std::vector<JointSummary>& start, Calibration& calibration) {
  const SmoothCorrections& smooth = model.smooth;
  for (std::size_t joint = 0; joint < calibration.joints.size(); ++joint) {
    JointSummary& summary = calibration.joints[joint];
    summary.origin = FormulaOrigin::unstated;
    if (!summary.kept) continue;
    const bool has_base = joint < smooth.base.size() && !smooth.base[joint].is_neutral();
    bool has_terms = false;
    for (std::size_t i = 0; i < smooth.terms.size(); ++i)
      has_terms = has_terms || (smooth.terms[i].joint == static_cast<int>(joint) &&
                                smooth.coefficients[static_cast<Eigen::Index>(i)] != 0.0);
    if (has_base && joint < start.size()) summary.origin = start[joint].origin;
    if (!has_base) summary.origin = FormulaOrigin::smooth_terms;
    if (has_base && has_terms && summary.origin == FormulaOrigin::evolved)
      summary.origin = FormulaOrigin::evolved_and_smooth_terms;
  }
}

Preparation prepare_beside_effects(const DataSet& data, const Preparation& first, const CorrectedRobot& model) {
  Preparation again = first;
  again.declared.robot = without_corrections(model);
  again.targets = targets_about(data, first, model);
  again.training = training_tables(again.declared.robot.chain, again.targets, first.corrections);
  return again;
}

void keep_first_figures(const Calibration& first, Calibration& calibration) {
  calibration.index_before_mm2 = first.index_before_mm2;
  for (std::size_t i = 0; i < calibration.joints.size(); ++i) {
    calibration.joints[i].before_rad = first.joints[i].before_rad;
  }
}

DiagnosedModel with_fixed_corrections(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                                      const CorrectedRobot& robot) {
  DeclaredModel without_terms = declared;
  without_terms.joint_corrections = false;
  const DiagnosisProblem problem{data, without_terms, poses_of(data, PoseSet::calibration), {}};
  return diagnosed_model(problem, loop_start(data, fit, robot));
}

ErrorBudget error_budget_of(const DataSet& data, const DeclaredModel& declared, const DiagnosedModel& model,
                            const ExplanationFront& front, const DiagnosedModel& last, std::uint64_t seed) {
  const DiagnosisProblem problem{data, declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  return error_budget(problem, model, front, poses_of_last_fit(data), last,
                      RandomStream{seed, number_of(RandomPurpose::cause_cost)});
}

std::optional<Calibration> calibration_of_best(const DataSet& data, const DeclaredModel& declared,
                                               const Preparation& preparation, const CorrectedRobot& before,
                                               std::optional<DiagnosedModel> best) {
  if (!best) return std::nullopt;
  std::optional<UnseenValidation> unseen;
  if (sees_more_at_last(data)) unseen = unseen_validation(data, declared, before, best->robot);
  DiagnosedModel model = final_fit(data, declared, std::move(*best));
  drop_negligible_terms(model);
  model = with_bounded_corrections(data, declared, preparation, poses_of_last_fit(data), std::move(model));
  Calibration calibration = calibration_of(data, declared, preparation, model);
  calibration.unseen = std::move(unseen);
  return calibration;
}

std::optional<LastFit> last_fit(const DataSet& data, const DeclaredModel& declared, const Preparation& preparation,
                                LoopModels ends) {
  if (!sees_more_at_last(data)) return std::nullopt;
  UnseenValidation unseen = unseen_validation(data, declared, ends.before.robot, ends.after.robot);
  for (DiagnosedModel* model : {&ends.before, &ends.after}) {
    *model = final_fit(data, declared, std::move(*model));
    drop_negligible_terms(*model);
  }
  ends.after = with_bounded_corrections(data, declared, preparation, poses_of_last_fit(data), std::move(ends.after));
  return LastFit{std::move(ends), std::move(unseen)};
}

}  // namespace demecal::inline closed_calibration
