#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/explain.hpp"
#include "diagnosis/group.hpp"
#include "diagnosis/judgement.hpp"
#include "diagnosis/outcome.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline diagnosis {
namespace {

/// The columns of the new effects, one after another.
struct NewColumns {
  EffectColumns fitted, validation;
  RowMatrix over_fitted, over_validation;
};

NewColumns new_columns(const LoopEnd& end, const Linearization& linearization, const std::vector<Effect>& effects) {
  NewColumns columns;
  columns.fitted.append(effects, end.problem.data.robot, linearization.fitted.states);
  columns.validation.append(effects, end.problem.data.robot, linearization.validation.states);
  columns.fitted.pack();
  columns.validation.pack();
  columns.over_fitted = columns.fitted.dense(linearization.fitted);
  columns.over_validation = columns.validation.dense(linearization.validation);
  return columns;
}

/// The trial of some of the columns beside all others: what a fit of all says of them.
Projection::Trial beside_others(const Projection::Trial& all, const Eigen::MatrixXd& inverse, const ColumnSpan& span) {
  const Eigen::MatrixXd own = inverse.block(span.first, span.first, span.count, span.count);
  const Eigen::MatrixXd turn =
      PivotedCholesky(own).solve(inverse.middleCols(span.first, span.count).transpose()).transpose();
  Projection::Trial trial;
  trial.fitted = all.fitted * turn;
  trial.validation = all.validation * turn;
  trial.coefficients = all.coefficients.segment(span.first, span.count);
  trial.drop = trial.coefficients.dot(PivotedCholesky(own).solve(trial.coefficients));
  trial.rank = span.count;
  trial.validation_residual = all.validation_residual;
  return trial;
}

class JointJudgement {
 public:
  JointJudgement(const LoopEnd& end, const DiagnosedModel& model, const Linearization& linearization)
      : end_(end), model_(model), linearization_(linearization) {}

  Round round_of(const Effect& effect, const Projection::Trial& trial, const Eigen::VectorXd& left, double squares,
                 int number) const;

 private:
  std::string objection(const Round& round) const;
  RandomStream random(RandomPurpose purpose, int number) const {
    return RandomStream{end_.rules.seed, number_of(purpose), static_cast<std::uint64_t>(end_.rules.group),
                        static_cast<std::uint64_t>(number)};
  }

  const LoopEnd& end_;
  const DiagnosedModel& model_;
  const Linearization& linearization_;
};

std::string JointJudgement::objection(const Round& round) const {
  if (round.p_family > end_.rules.family_error) return "not significant (p = " + rounded_text(round.p_family) + ")";
  if (round.sign_stability < kStableSign) return "unstable under bootstrap resampling";
  return implausibility(round.effect, end_.problem, model_, linearization_.fitted.states);
}

Round JointJudgement::round_of(const Effect& effect, const Projection::Trial& trial, const Eigen::VectorXd& left,
                               double squares, int number) const {
  const ResidualField& validation = linearization_.validation;
  const Eigen::VectorXd without = trial.validation_residual + trial.validation * trial.coefficients;
  Round round;
  round.number = end_.rules.first_round + number;
  round.group = end_.rules.group;
  round.effect = effect;
  round.effect.values.assign(trial.coefficients.begin(), trial.coefficients.end());
  round.p_structure = end_.rules.p_structure;
  const auto rows = static_cast<double>(linearization_.fitted.rows());
  const auto poses = static_cast<double>(distinct_poses(linearization_.fitted));
  round.gain_nats = 0.5 * rows * std::log1p(trial.drop / squares) -
                    0.5 * static_cast<double>(trial.rank) * std::log(poses) - naming_cost_nats(effect, end_.candidates);
  round.p_family = family_p_value(end_.null_maxima, round.gain_nats);
  round.null_draws = static_cast<int>(end_.null_maxima.size());
  if (!validation.poses.empty()) {
    round.validation_before_mm = mean(tool_errors_mm(validation, without, model_.scales, end_.problem.data));
    round.validation_after_mm =
        mean(tool_errors_mm(validation, trial.validation_residual, model_.scales, end_.problem.data));
    const Confirmation borne_out =
        confirmation(pose_errors_mm(validation, without, model_.scales),
                     pose_errors_mm(validation, trial.validation_residual, model_.scales),
                     pose_errors_mm(validation, without - trial.validation_residual, model_.scales), validation.group,
                     random(RandomPurpose::effect_gain, number), end_.rules.do_work);
    round.confirmed = borne_out.share;
    round.confirmed_lower = borne_out.lower;
  }
  const Resampled draws =
      resampled(linearization_.fitted, trial, left + trial.fitted * trial.coefficients, end_.rules.resamples,
                random(RandomPurpose::effect_scatter, number), end_.rules.do_work);
  round.sign_stability = draws.sign_stability;
  round.interval = draws.interval;
  round.diagnosis = law_of(effect).diagnosis(round.effect, end_.problem.data.robot);
  round.formula = law_of(effect).formula(round.effect, end_.problem.data.robot);
  round.reason = objection(round);
  round.verdict = round.reason.empty() ? Verdict::added : Verdict::rejected;
  return round;
}

}  // namespace

std::vector<Round> judged_together(const LoopEnd& end, const DiagnosedModel& model) {
  std::vector<bool> is_new;
  std::vector<Effect> effects;
  for (const Effect& effect : model.robot.effects) {
    const auto is_it = [&](const Effect& other) { return other.same_law_as(effect); };
    is_new.push_back(std::ranges::none_of(end.model.robot.effects, is_it));
    if (is_new.back()) effects.push_back(effect);
  }
  if (effects.empty()) return {};
  const Linearization linearization = linearize_without(end.problem, model, is_new);
  const NewColumns columns = new_columns(end, linearization, effects);
  const Projection::Trial all = linearization.projection.trial(columns.over_fitted, columns.over_validation);
  const Eigen::VectorXd left = linearization.projection.residual() - all.fitted * all.coefficients;
  const Eigen::MatrixXd gram = square_product(all.fitted) + all.prior.transpose() * all.prior;
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  scaled.diagonal().array() += kNewShare;
  const Eigen::MatrixXd inverse = scale.asDiagonal() * Cholesky(scaled).inverse() * scale.asDiagonal();
  const double squares = linearization.projection.squares() - all.drop;
  const JointJudgement judgement(end, model, linearization);
  std::vector<Round> rounds;
  for (std::size_t i = 0; i < effects.size(); ++i)
    rounds.push_back(judgement.round_of(effects[i], beside_others(all, inverse, columns.fitted.spans()[i]), left,
                                        squares, static_cast<int>(i)));
  return rounds;
}

}  // namespace demecal::inline diagnosis
