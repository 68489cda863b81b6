#include "diagnosis/loop.hpp"
#include "next_measurement/next_measurement.hpp"
#include "random/random_stream.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/effect.hpp"
#include "parameters/declared_model.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/noise_estimation.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr int kRefitSteps = 3;
constexpr int kStepsWithNoise = 3;
constexpr std::size_t kMostPosesForNoise = 400;

/// The columns of each effect among the free parameters.
std::vector<std::vector<Eigen::Index>> effect_column_indices(const Linearization& linearization, std::size_t effects) {
  std::vector<std::vector<Eigen::Index>> columns(effects);
  for (std::size_t i = 0; i < linearization.ids.size(); ++i) {
    if (linearization.ids[i].kind == ParameterId::Kind::effect) {
      columns[static_cast<std::size_t>(linearization.ids[i].index)].push_back(static_cast<Eigen::Index>(i));
    }
  }
  return columns;
}

/// Rise of the sum of squares if these coefficients were zero (Wald). They are taken in their standard errors: what the
/// poses tell nothing of is uncertain by so much more that beside it the rest would count as exact.
double rise_without(const Linearization& linearization, const Effect& effect,
                    const std::vector<Eigen::Index>& columns) {
  const Eigen::MatrixXd covariance = linearization.covariance(columns, columns);
  const Eigen::VectorXd unit = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::VectorXd values = linearization.changes(columns);
  for (std::size_t i = 0; i < columns.size(); ++i) values[static_cast<Eigen::Index>(i)] += effect.value(i);
  values.array() *= unit.array();
  return values.dot(least_norm_solution(unit.asDiagonal() * covariance * unit.asDiagonal(), values));
}

/// The effect whose loss would shorten the description most, if any would.
std::optional<std::size_t> least_needed(const Linearization& linearization, const CorrectedRobot& robot,
                                        const std::vector<Candidate>& candidates) {
  const auto columns = effect_column_indices(linearization, robot.effects.size());
  const double variance = linearization.projection.squares() / linearization.projection.freedom();
  const double price_of_one = 0.5 * std::log(static_cast<double>(linearization.fitted.poses.size()));
  std::optional<std::size_t> worst;
  double least = 0.0;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const double rise = rise_without(linearization, robot.effects[i], columns[i]) / variance;
    const double gain = 0.5 * rise - price_of_one * static_cast<double>(columns[i].size()) -
                        naming_cost_nats(robot.effects[i], candidates);
    if (gain < least) {
      least = gain;
      worst = i;
    }
  }
  return worst;
}

constexpr double kWorse = 1.05;  ///< a fit that leaves this much more of its own poses' errors is not taken

/// Mean squared tool error over the poses, errors beyond ten times the median counted as these.
double capped_index_m2(const DiagnosisProblem& problem, const CorrectedRobot& robot) {
  constexpr double kFarOut = 10.0;
  const std::vector<double> errors_m = tool_errors_m(robot, problem.data, problem.fitted);
  const double most_m = kFarOut * median(errors_m);
  double squares = 0.0;
  for (const double error_m : errors_m) squares += std::pow(std::min(error_m, most_m), 2);
  return squares / static_cast<double>(errors_m.size());
}

const Effect* held_effect(const CorrectedRobot& model, const Effect& effect) {
  const auto found = std::ranges::find_if(model.effects, [&](const Effect& one) { return one.same_law_as(effect); });
  return found == model.effects.end() ? nullptr : &*found;
}

}  // namespace

PositionSums position_errors(const DiagnosisProblem& problem, const Linearization& linearization,
                             const RowScales& scales) {
  const RowMatrix errors = unwhitened(linearization.fitted, linearization.errors);
  PositionSums sum;
  for (std::size_t i = 0; i < linearization.fitted.poses.size(); ++i) {
    const Eigen::Index first = linearization.fitted.first_row[i];
    if (!problem.data.poses[linearization.fitted.poses[i]].position_m) continue;
    sum.squares += errors.middleRows(first, 3).squaredNorm();
    sum.freedom += 3.0 - linearization.projection.basis().middleRows(first, 3).squaredNorm();
  }
  sum.squares *= std::pow(scales[kPosition], 2);
  return sum;
}

DiagnosedModel with_noise_known(const DiagnosisProblem& problem, DiagnosedModel model, bool first) {
  constexpr int kRounds = 2;
  if (problem.fitted.size() > kMostPosesForNoise || has_contacts(problem.data)) return model;
  const bool several_kinds = std::ranges::count_if(model.scales, [](double scale) { return scale > 0.0; }) > 1;
  if (!first && several_kinds) {
    // An effect that was missing may have shown in one kind of rows more than in another.
    model.noise = {};
    model.noise_estimated = false;
    model = refined(problem, std::move(model), kStepsWithNoise);
  }
  for (int round = 0; round < kRounds - (first ? 0 : 1); ++round) {
    model = with_noise_estimated(problem, std::move(model));
    model = refined(problem, std::move(model), kStepsWithNoise);
  }
  return model;
}

void measure_lack_of_fit(const DiagnosisProblem& problem, const DiagnosedModel& model,
                         const Linearization& linearization, std::optional<double>& start_excess_m2,
                         LoopOutcome& outcome) {
  if (const auto plain = pure_error(problem.data, problem.fitted)) outcome.repeat_scatter_m = plain->deviation_m;
  // Repeats by a precise instrument say nothing of what a coarse one leaves: all in units of their station's noise.
  const auto pure = pure_error(problem.data, problem.fitted, model.scales);
  if (!pure) return;
  const auto [squares, freedom] = position_errors(problem, linearization, model.scales);
  if (!outcome.lack_of_fit_p) outcome.lack_of_fit_p = lack_of_fit_p_value(*pure, squares, freedom);
  const double left = squares / freedom - std::pow(pure->deviation_m, 2);
  if (!start_excess_m2) start_excess_m2 = left;
  if (*start_excess_m2 > 0.0) outcome.explained_share = 1.0 - std::max(0.0, left) / *start_excess_m2;
}

void update_rounds(LoopOutcome& outcome, const CorrectedRobot& model, const Robot& described) {
  for (Round& round : outcome.rounds) {
    if (round.verdict != Verdict::added) continue;
    if (const Effect* effect = held_effect(model, round.effect)) {
      round.effect = *effect;
      if (!effect->standard_errors.empty()) round.interval = confidence_intervals(*effect);
      round.diagnosis = law_of(*effect).diagnosis(*effect, described);
      round.formula = law_of(*effect).formula(*effect, described);
    } else {
      round.verdict = Verdict::rejected;
      round.reason = "taken back: the model that was kept does without it";
      const auto is_it = [&](const Effect& one) { return one.same_law_as(round.effect); };
      if (std::ranges::none_of(outcome.dropped, is_it)) outcome.dropped.push_back(round.effect);
    }
  }
}

void update_rivals(const FinishedLoop& loop, std::vector<Round>& rounds) {
  const auto columns = effect_column_indices(loop.linearization, loop.model.robot.effects.size());
  in_pieces(rounds.size(), [&](std::size_t i) {
    const Effect* const held = held_effect(loop.model.robot, rounds[i].effect);
    if (rounds[i].verdict != Verdict::added || held == nullptr) return;
    const std::vector<Eigen::Index>& own = columns[static_cast<std::size_t>(held - loop.model.robot.effects.data())];
    Eigen::VectorXd values = loop.linearization.changes(own);
    for (std::size_t k = 0; k < own.size(); ++k) values[static_cast<Eigen::Index>(k)] += held->value(k);
    const ModelPart part = part_of_model(loop.linearization.projection.to_basis()(own, Eigen::all), values);
    rounds[i].rivals = rivals_of_held(*held, part, loop.candidates, loop.scan);
  });
}

void find_next_measurements(const DiagnosisProblem& problem, const DiagnosedModel& model, const RandomStream& random,
                            std::vector<Round>& rounds) {
  constexpr std::size_t kMost = 3;
  if (!has_instrument(problem.data)) return;  // poses that nothing measures: a contact cannot be had anywhere
  std::size_t asked = 0;
  for (Round& round : rounds) {
    if (asked == kMost || !is_ambiguous(round, rounds)) continue;
    ++asked;
    round.next_measurement = find_next_measurement(problem, model, round.effect, round.rivals, random);
  }
}

bool leaves_more(const DiagnosisProblem& problem, const DiagnosedModel& model, const DiagnosedModel& than) {
  return capped_index_m2(problem, model.robot) > std::pow(kWorse, 2) * capped_index_m2(problem, than.robot);
}

Linearization eliminate_backward(const DiagnosisProblem& problem, DiagnosedModel& model,
                                 const std::vector<Candidate>& candidates, LoopOutcome& outcome) {
  for (;;) {
    Linearization linearization = linearize(problem, model);
    const auto index = least_needed(linearization, model.robot, candidates);
    if (!index) return linearization;
    const auto dropped = model.robot.effects.begin() + static_cast<std::ptrdiff_t>(*index);
    for (Round& round : outcome.rounds) {
      if (round.verdict != Verdict::added || !round.effect.same_law_as(*dropped)) continue;
      round.verdict = Verdict::rejected;
      round.reason = "taken back by the backward step: no longer needed beside the others";
    }
    outcome.dropped.push_back(*dropped);
    model.robot.effects.erase(dropped);
    model = refined(problem, std::move(model), kRefitSteps);
  }
}

std::vector<std::size_t> poses_of_last_fit(const DataSet& data) {
  std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  if (poses_of(data, PoseSet::accept).empty()) return poses;
  std::ranges::copy(poses_of(data, PoseSet::validation), std::back_inserter(poses));
  std::ranges::sort(poses);
  return poses;
}

DiagnosedModel final_fit(const DataSet& data, const DeclaredModel& declared, DiagnosedModel model) {
  constexpr int kSteps = 12;
  const std::vector<std::size_t> poses = poses_of_last_fit(data);
  if (poses == poses_of(data, PoseSet::calibration)) return model;
  const Evidence evidence = evidence_of(data, poses);
  for (Effect& effect : model.robot.effects) set_measured_ranges(effect, data.robot, evidence);
  const DiagnosisProblem chosen{data, declared, poses_of(data, PoseSet::calibration), {}},
      all{data, declared, poses, {}};
  DiagnosedModel last = model;
  last.precision = linearize(chosen, model).precision.tail(model.smooth.coefficients.size());
  last = refined(all, std::move(last), kSteps);
  return leaves_more(all, last, model) ? model : last;
}

}  // namespace demecal::inline diagnosis
