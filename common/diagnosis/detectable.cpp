#include "diagnosis/detectable.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "diagnosis/judgement.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "pieces/pieces.hpp"
#include "products/tall_products.hpp"
#include "residuals/projection.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline diagnosis {
namespace {

/// What terms could absorb of a column one after another, the one that absorbs most first: of its squared length.
/// `moments`: terms^T column; `gram`: of the terms.
std::vector<double> absorbed_by_terms(Eigen::VectorXd moments, const Eigen::MatrixXd& gram) {
  constexpr int kMostTerms = 8;
  std::vector<double> parts;
  Eigen::VectorXd lengths = gram.diagonal();  // squared, of what of the terms is left
  Eigen::MatrixXd directions(gram.rows(), kMostTerms);
  for (int round = 0; round < kMostTerms; ++round) {
    Eigen::Index best = -1;
    double most = 0.0;
    for (Eigen::Index i = 0; i < moments.size(); ++i) {
      if (lengths[i] <= kNewShare * gram(i, i) || lengths[i] < kNoColumn) continue;
      const double part = moments[i] * moments[i] / lengths[i];
      if (part > most) {
        most = part;
        best = i;
      }
    }
    if (best < 0) break;
    parts.push_back(most);
    const auto before = directions.leftCols(round);
    auto direction = directions.col(round);
    direction = (gram.col(best) - before * before.row(best).transpose()) / std::sqrt(lengths[best]);
    moments -= direction * (moments[best] / std::sqrt(lengths[best]));
    lengths -= direction.cwiseAbs2();
  }
  return parts;
}

/// The same of every coefficient of every candidate.
void set_absorbed(std::vector<DetectableCandidate>& candidates, const FinishedLoop& loop, const Projection& beyond) {
  if (loop.model.smooth.terms.empty()) return;
  const ResidualField& fitted = loop.linearization.fitted;
  const RowMatrix terms = loop.model.smooth.columns(fitted);
  const RowMatrix left =
      beyond.unexplained(terms, RowMatrix::Zero(loop.linearization.validation.rows(), terms.cols())).fitted;
  const Eigen::MatrixXd gram = square_product(left);
  const Eigen::MatrixXd moments = loop.columns.transposed_times(fitted, left);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ColumnSpan& span = loop.columns.spans()[i];
    for (Eigen::Index k = 0; k < span.count; ++k)
      candidates[i].absorbed.push_back(absorbed_by_terms(moments.row(span.first + k).transpose(), gram));
  }
}

/// The square of a column over the validation poses, in units of how their residuals scatter along it: by whole poses,
/// for repeats share errors.
double validation_square(const Eigen::VectorXd& column, const ResidualField& validation, const Eigen::VectorXd& left) {
  std::map<std::size_t, double> along;
  for (std::size_t pose = 0; pose < validation.poses.size(); ++pose) {
    const Eigen::Index first = validation.first_row[pose], count = validation.rows_of_pose(pose);
    along[validation.group[pose]] += column.segment(first, count).dot(left.segment(first, count));
  }
  double scatter = 0.0;
  for (const auto& [group, sum] : along) scatter += sum * sum;
  const double square = column.squaredNorm();
  return scatter > 0.0 ? square * square / scatter : 0.0;
}

/// Of every candidate beyond the model: how well the validation poses see it, over how well the fitted ones do.
void set_validation_ratios(std::vector<DetectableCandidate>& candidates, const FinishedLoop& loop,
                           const Projection& beyond, const Scan& scan, double variance) {
  constexpr Eigen::Index kColumnsAtATime = 256;
  const ResidualField& validation = loop.linearization.validation;
  if (validation.poses.empty() || candidates.empty()) return;
  std::vector<SampledEffect> sampled;
  for (const Candidate& candidate : loop.candidates) sampled.push_back({candidate.effect, validation.states});
  EffectColumns columns;
  columns.append(sampled, loop.robot);
  columns.pack();
  const std::vector<ColumnSpan>& spans = columns.spans();
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 0; i < spans.size(); ++i)
    if (spans[i].first - spans[begins.back()].first >= kColumnsAtATime) begins.push_back(i);
  in_pieces(begins.size(), [&](std::size_t piece) {
    const std::size_t begin = begins[piece], end = piece + 1 < begins.size() ? begins[piece + 1] : spans.size();
    const Eigen::Index together = spans[end - 1].first + spans[end - 1].count - spans[begin].first;
    RowMatrix left(validation.rows(), together);
    for (std::size_t i = begin; i < end; ++i)
      left.middleCols(spans[i].first - spans[begin].first, spans[i].count) = columns.dense(validation, i);
    left -= product(beyond.validation_basis(), scan.along().middleRows(spans[begin].first, together).transpose());
    for (std::size_t i = begin; i < end; ++i) {
      double seen = 0.0;
      for (Eigen::Index k = 0; k < spans[i].count; ++k)
        seen += validation_square(left.col(spans[i].first - spans[begin].first + k), validation,
                                  beyond.validation_residual());
      const double square = candidates[i].score.visible.sum() / variance;
      candidates[i].validation_ratio = square > 0.0 ? seen / square : 0.0;
    }
  });
}

/// Marks what only an effect larger than plausible of its kind would show, over the states of the poses.
void mark_untestable(std::vector<NotFound>& not_found, const Robot& robot, const std::vector<ArmState>& states) {
  for (NotFound& missing : not_found) {
    missing.testable = std::isfinite(missing.smallest_detectable);
    if (!missing.testable) continue;
    Effect effect = missing.effect;
    effect.values.assign(law_of(effect).coefficients(effect, robot).size(), 0.0);
    effect.values.front() = missing.smallest_detectable;
    const LargestMotion needed = farthest_motion(effect, robot, states);
    const Cause& cause = cause_of(effect.kind);
    missing.testable = needed.turn_rad <= cause.largest_turn_rad && needed.shift_m <= cause.largest_shift_m;
  }
}

/// The candidates that were refused as larger than a real arm's effects.
std::vector<std::size_t> refused(const std::vector<Candidate>& candidates, const std::vector<Round>& rounds) {
  std::vector<std::size_t> found;
  for (const Round& round : rounds) {
    if (!round.implausible) continue;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const bool real = candidates[i].decoy_kind == DecoyKind::none;
      if (real && candidates[i].effect.same_law_as(round.effect)) found.push_back(i);
    }
  }
  return found;
}

/// Kinds of which the model holds no effect, and beyond which nothing of them is visible: what is declared explains
/// them.
std::vector<UntestableKind> hidden_kinds(const FinishedLoop& loop, const std::vector<Score>& scores) {
  std::set<std::string> hidden, seen;
  for (const Effect& effect : loop.model.robot.effects) seen.insert(effect.kind);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const Candidate& candidate = loop.candidates[i];
    if (candidate.decoy_kind != DecoyKind::none || is_symbolic(candidate.effect)) continue;
    (scores[i].rank == 0 ? hidden : seen).insert(candidate.effect.kind);
  }
  std::vector<UntestableKind> kinds;
  for (const std::string& kind : hidden)
    if (!seen.contains(kind))
      kinds.push_back({kind, "what is declared explains the same: these poses cannot tell it from that"});
  return kinds;
}

}  // namespace

void raise_to_what_was_found(const std::vector<Effect>& taken_back, const Robot& robot,
                             std::vector<NotFound>& not_found) {
  for (NotFound& missing : not_found) {
    for (const Effect& effect : taken_back) {
      if (effect.kind != missing.effect.kind || effect.joint != missing.effect.joint) continue;
      const std::vector<CoefficientLabel> labels = law_of(effect).coefficients(effect, robot);
      double size = 0.0;
      for (std::size_t i = 0; i < std::min(labels.size(), effect.values.size()); ++i)
        if (labels[i].unit == missing.unit) size = std::hypot(size, effect.values[i]);
      missing.smallest_detectable = std::max(missing.smallest_detectable, size);
    }
  }
}

void find_limits(const FinishedLoop& loop, const std::vector<double>& null_maxima, const BoundOptions& options,
                 RandomStream random, LoopOutcome& outcome) {
  Projection beyond = loop.linearization.projection;
  const std::vector<std::size_t> set_aside = refused(loop.candidates, loop.rounds);
  for (const std::size_t index : set_aside) {
    const auto count = loop.columns.spans()[index].count;
    const RowMatrix validation = RowMatrix::Zero(loop.linearization.validation.rows(), count);
    beyond.add(beyond.trial(loop.columns.dense(loop.linearization.fitted, index), validation));
  }
  const Scan scan = set_aside.empty() ? loop.scan
                                      : Scan(loop.columns, naming_costs_nats(loop.candidates),
                                             loop.linearization.fitted, beyond, options.do_work);
  std::vector<double> maxima = null_maxima;
  if (!set_aside.empty())
    maxima =
        scan.null_maxima(loop.columns, loop.linearization.fitted, beyond, options.null_draws, random, options.do_work);
  const double variance = beyond.squares() / beyond.freedom();
  const std::vector<Score> scores = scan.scores();
  std::vector<DetectableCandidate> candidates;
  for (std::size_t i = 0; i < scores.size(); ++i) candidates.push_back({loop.candidates[i], scores[i]});
  set_validation_ratios(candidates, loop, beyond, scan, variance);
  set_absorbed(candidates, loop, beyond);
  std::vector<NotFound> all = smallest_detectable(candidates, loop.model.robot, loop.robot,
                                                  {.null_maxima = maxima,
                                                   .family_error = options.family_error,
                                                   .variance = variance,
                                                   .poses = loop.linearization.fitted.poses.size()});
  mark_untestable(all, loop.robot, loop.linearization.fitted.states);
  raise_to_what_was_found(outcome.dropped, loop.robot, all);
  outcome.not_found = std::move(all);
  std::ranges::move(hidden_kinds(loop, scores), std::back_inserter(outcome.untestable));
}

}  // namespace demecal::inline diagnosis
