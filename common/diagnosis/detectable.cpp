#include "diagnosis/detectable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "diagnosis/judgement.hpp"
#include "effects/catalogue.hpp"

namespace demecal {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::infinity();
/// Of what is visible of a gear's harmonic: one of which joint corrections could take more is as slow as they are, and
/// is theirs.
constexpr double kLeastOwn = 0.2;

bool holds(const CorrectedRobot& model, const Effect& effect) {
  return std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& present) {
    return present.kind == effect.kind && present.joint == effect.joint;
  });
}

double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// How likely an effect is found that stands so many standard deviations above the noise of the fitted poses: by the
/// scan, and then by the poses that judge, which see `judged` of its square. Group's two conditions: more than half of
/// it is borne out, and surely some of it.
double power(double signal, double threshold, std::optional<double> judged) {
  constexpr double kOneSided95 = 1.6449;
  const double scanned = normal_below(signal - threshold);
  if (!judged) return scanned;
  const double seen = signal * std::sqrt(*judged);
  return scanned * std::min(normal_below(0.5 * seen), normal_below(seen - kOneSided95));
}

/// How one candidate of a kind and joint shows.
struct Showing {
  std::vector<double> visible;             ///< per coefficient of the first one's unit: square of a unit of it
  std::vector<std::vector<double>> taken;  ///< of the same, what single smooth terms could take; or empty
  double threshold = 0.0;                  ///< standard deviations from which it is found
  std::optional<double> judged;            ///< what the poses that judge see of its square

  /// In standard deviations; a term takes its part where that is so much that it is kept.
  double signal(double size) const {
    constexpr double kKept = 9.0;  // three standard errors, as SmoothCorrections' relevance asks
    double square = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      double left = visible[i];
      for (const double part : taken.empty() ? std::vector<double>{} : taken[i])
        left -= size * size * part > kKept ? part : 0.0;
      square += std::max(left, 0.0);
    }
    return size * std::sqrt(square / static_cast<double>(visible.size()));
  }
  /// The share of it that no smooth terms could take.
  double own() const {
    double all = 0.0, theirs = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      all += visible[i];
      if (!taken.empty()) theirs += std::accumulate(taken[i].begin(), taken[i].end(), 0.0);
    }
    return all > 0.0 ? 1.0 - theirs / all : 0.0;
  }
};

Showing showing(std::size_t index, const Candidate& candidate, const Score& score, const Robot& robot,
                const Detection& detection) {
  Showing result;
  const auto coefficients = law_of(candidate.effect).coefficients(candidate.effect, robot);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (coefficients[i].unit != coefficients.front().unit) continue;
    result.visible.push_back(score.visible[static_cast<Eigen::Index>(i)] / detection.variance);
    if (detection.taken.empty()) continue;
    result.taken.push_back(detection.taken[index][i]);
    for (double& part : result.taken.back()) part /= detection.variance;
  }
  const auto place =
      static_cast<std::size_t>((1.0 - detection.family_error) * static_cast<double>(detection.null_maxima.size() - 1));
  const double price = 0.5 * static_cast<double>(score.rank) * std::log(static_cast<double>(detection.poses));
  result.threshold = std::sqrt(2.0 * (std::max(0.0, detection.null_maxima[place]) + price + candidate.name_nats));
  if (!detection.judged.empty()) result.judged = detection.judged[index];
  return result;
}

/// The size from which on `showings` are found with power 0.9 on average.
double amplitude(const std::vector<Showing>& showings) {
  constexpr double kPower = 0.9, kMostSignal = 1e3, kStep = 1.01;
  const auto is_found = [&](double size) {
    double sum = 0.0;
    for (const Showing& one : showings) sum += power(one.signal(size), one.threshold, one.judged);
    return sum >= kPower * static_cast<double>(showings.size());
  };
  double least_visible = kUnseen;
  for (const Showing& one : showings)
    least_visible = std::min(least_visible, std::ranges::max(one.visible) * std::max(one.own(), kNewShare));
  double size = kMostSignal / std::sqrt(least_visible);
  if (!std::isfinite(size) || !is_found(size)) return kUnseen;
  while (is_found(size / kStep)) size /= kStep;
  return size;
}

/// What terms could take of a column one after another, the one that takes most first: of its squared length.
/// `moments`: terms^T column; `gram`: of the terms.
std::vector<double> taken_by_terms(Eigen::VectorXd moments, const Eigen::MatrixXd& gram) {
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
std::vector<std::vector<std::vector<double>>> taken_of(const EndedLoop& loop, const Projection& beyond) {
  if (loop.model.smooth.terms.empty()) return {};
  const RowMatrix terms = loop.model.smooth.columns(loop.at.fitted);
  const RowMatrix left = beyond.trial(terms, RowMatrix::Zero(loop.at.judging.rows(), terms.cols())).fitted;
  const Eigen::MatrixXd gram = left.transpose() * left;
  const Eigen::MatrixXd moments = loop.columns.transposed_times(loop.at.fitted, left);
  std::vector<std::vector<std::vector<double>>> taken;
  for (const ColumnSpan& span : loop.columns.spans()) {
    taken.emplace_back();
    for (Eigen::Index i = 0; i < span.count; ++i)
      taken.back().push_back(taken_by_terms(moments.row(span.first + i).transpose(), gram));
  }
  return taken;
}

/// The square of a column over the poses that judge, in units of how their residuals scatter along it: by whole poses,
/// for repeats share errors.
double judged_square(const Eigen::VectorXd& column, const ResidualField& judging, const Eigen::VectorXd& left) {
  std::map<std::size_t, double> along;
  for (std::size_t pose = 0; pose < judging.poses.size(); ++pose) {
    const Eigen::Index first = judging.first_row[pose], count = judging.rows_of_pose(pose);
    along[judging.group[pose]] += column.segment(first, count).dot(left.segment(first, count));
  }
  double scatter = 0.0;
  for (const auto& [group, sum] : along) scatter += sum * sum;
  const double square = column.squaredNorm();
  return scatter > 0.0 ? square * square / scatter : 0.0;
}

/// Of every candidate beyond the model: how well the poses that judge see it, over how well those that fit do.
std::vector<double> judged_shares(const EndedLoop& loop, const Projection& beyond, double variance) {
  if (loop.at.judging.poses.empty()) return {};
  EffectColumns judging;
  for (const Candidate& candidate : loop.candidates)
    judging.append(candidate.effect, loop.robot, loop.at.judging.states);
  judging.pack();
  std::vector<double> shares;
  for (std::size_t i = 0; i < loop.candidates.size(); ++i) {
    const Projection::Trial trial =
        beyond.trial(loop.columns.dense(loop.at.fitted, i), judging.dense(loop.at.judging, i));
    double judged = 0.0;
    for (const auto& column : trial.judging.colwise())
      judged += judged_square(column, loop.at.judging, beyond.judging_left());
    const double fitted = trial.fitted.squaredNorm() / variance;
    shares.push_back(fitted > 0.0 ? judged / fitted : 0.0);
  }
  return shares;
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
      const bool real = candidates[i].disguise == Disguise::none;
      if (real && candidates[i].effect.same_law_as(round.effect)) found.push_back(i);
    }
  }
  return found;
}

}  // namespace

std::vector<NotFound> smallest_detectable(const std::vector<Candidate>& candidates, const std::vector<Score>& scores,
                                          const CorrectedRobot& model, const Robot& robot, const Detection& detection) {
  std::vector<NotFound> all;
  std::vector<std::vector<Showing>> showings;  // one of each of `all`
  if (detection.null_maxima.empty()) return all;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const Effect& effect = candidate.effect;
    if (is_symbolic(effect)) continue;
    if (candidate.disguise != Disguise::none || scores[i].rank == 0 || holds(model, effect)) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const NotFound& other) {
      return other.effect.kind == effect.kind && other.effect.joint == effect.joint;
    });
    const auto at = static_cast<std::size_t>(same - all.begin());
    if (same == all.end()) {
      all.push_back({effect, 0.0, law_of(effect).coefficients(effect, robot).front().unit});
      showings.emplace_back();
    } else if (effect.form != same->effect.form) {
      continue;
    }
    Showing shows = showing(i, candidate, scores[i], robot, detection);
    if (!is_harmonic(effect.kind) || shows.own() >= kLeastOwn) showings[at].push_back(std::move(shows));
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].smallest_detectable = showings[i].empty() ? kUnseen : amplitude(showings[i]);
  return all;
}

std::vector<NotFound> not_found_beyond(const EndedLoop& loop, const std::vector<double>& null_maxima,
                                       const BoundOptions& options, RandomStream random) {
  Projection beyond = loop.at.projection;
  const std::vector<std::size_t> set_aside = refused(loop.candidates, loop.rounds);
  for (const std::size_t index : set_aside) {
    const auto count = loop.columns.spans()[index].count;
    const RowMatrix judging = RowMatrix::Zero(loop.at.judging.rows(), count);
    beyond.add(beyond.trial(loop.columns.dense(loop.at.fitted, index), judging));
  }
  const Scan scan(loop.columns, prices_nats(loop.candidates), loop.at.fitted, beyond);
  std::vector<double> maxima = null_maxima;
  if (!set_aside.empty()) maxima = scan.null_maxima(loop.columns, loop.at.fitted, beyond, options.permutations, random);
  const double variance = beyond.squares() / beyond.freedom();
  std::vector<NotFound> all = smallest_detectable(loop.candidates, scan.scores(), loop.model.robot, loop.robot,
                                                  {.null_maxima = maxima,
                                                   .family_error = options.family_error,
                                                   .variance = variance,
                                                   .poses = loop.at.fitted.poses.size(),
                                                   .judged = judged_shares(loop, beyond, variance),
                                                   .taken = taken_of(loop, beyond)});
  mark_untestable(all, loop.robot, loop.at.fitted.states);
  return all;
}

}  // namespace demecal
