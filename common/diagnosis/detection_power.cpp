#include "diagnosis/detectable.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/scan.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/projection.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr double kUndetectable = std::numeric_limits<double>::infinity();
/// Of what is visible of a gear's harmonic: one of which joint corrections could absorb more is as slow as they are,
/// and is theirs.
constexpr double kLeastOwn = 0.2;

bool holds_kind(const CorrectedRobot& model, const Effect& effect) {
  return std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& present) {
    return present.kind == effect.kind && present.joint == effect.joint;
  });
}

double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// How likely an effect is found that stands so many standard deviations above the noise of the fitted poses: by the
/// scan, and then by the validation poses, which see `validation_ratio` of its square. Group's two conditions: more
/// than half of it is borne out, and surely some of it.
double power(double signal, double threshold, std::optional<double> validation_ratio) {
  constexpr double kOneSided95 = 1.6449;
  const double scanned = normal_below(signal - threshold);
  if (!validation_ratio) return scanned;
  const double seen = signal * std::sqrt(*validation_ratio);
  return scanned * std::min(normal_below(0.5 * seen), normal_below(seen - kOneSided95));
}

/// The signal of one candidate of a kind and joint.
struct CandidateSignal {
  std::vector<double> visible;                ///< per coefficient of the first one's unit: square of a unit of it
  std::vector<std::vector<double>> absorbed;  ///< of the same, what single smooth terms could absorb; or empty
  double threshold = 0.0;                     ///< standard deviations from which it is found
  std::optional<double> validation_ratio;     ///< what the validation poses see of its square

  /// In standard deviations; a term takes its part where that is so much that it is kept.
  double size_of(double amplitude) const {
    constexpr double kKept = 9.0;  // three standard errors, as SmoothCorrections' relevance asks
    double square = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      double left = visible[i];
      for (const double part : absorbed.empty() ? std::vector<double>{} : absorbed[i])
        left -= amplitude * amplitude * part > kKept ? part : 0.0;
      square += std::max(left, 0.0);
    }
    return amplitude * std::sqrt(square / static_cast<double>(visible.size()));
  }
  /// The share of it that no smooth terms could absorb.
  double own_share() const {
    double all = 0.0, theirs = 0.0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      all += visible[i];
      if (!absorbed.empty()) theirs += std::accumulate(absorbed[i].begin(), absorbed[i].end(), 0.0);
    }
    return all > 0.0 ? 1.0 - theirs / all : 0.0;
  }
};

CandidateSignal signal_of(const DetectableCandidate& one, const Robot& robot, const Detection& detection) {
  CandidateSignal signal;
  const auto coefficients = law_of(one.candidate.effect).coefficients(one.candidate.effect, robot);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (coefficients[i].unit != coefficients.front().unit) continue;
    signal.visible.push_back(one.score.visible[static_cast<Eigen::Index>(i)] / detection.variance);
    if (one.absorbed.empty()) continue;
    signal.absorbed.push_back(one.absorbed[i]);
    for (double& part : signal.absorbed.back()) part /= detection.variance;
  }
  const auto place =
      static_cast<std::size_t>((1.0 - detection.family_error) * static_cast<double>(detection.null_maxima.size() - 1));
  const double price = 0.5 * static_cast<double>(one.score.rank) * std::log(static_cast<double>(detection.poses));
  signal.threshold =
      std::sqrt(2.0 * (std::max(0.0, detection.null_maxima[place]) + price + one.candidate.naming_cost_nats));
  signal.validation_ratio = one.validation_ratio;
  return signal;
}

/// The amplitude from which on `signals` are found with power 0.9 on average.
double detectable_amplitude(const std::vector<CandidateSignal>& signals) {
  constexpr double kPower = 0.9, kMostSignal = 1e3, kStep = 1.01;
  const auto is_found = [&](double amplitude) {
    double sum = 0.0;
    for (const CandidateSignal& one : signals)
      sum += power(one.size_of(amplitude), one.threshold, one.validation_ratio);
    return sum >= kPower * static_cast<double>(signals.size());
  };
  double least_visible = kUndetectable;
  for (const CandidateSignal& one : signals)
    least_visible = std::min(least_visible, std::ranges::max(one.visible) * std::max(one.own_share(), kNewShare));
  double amplitude = kMostSignal / std::sqrt(least_visible);
  if (!std::isfinite(amplitude) || !is_found(amplitude)) return kUndetectable;
  while (is_found(amplitude / kStep)) amplitude /= kStep;
  return amplitude;
}

}  // namespace

std::vector<NotFound> smallest_detectable(const std::vector<DetectableCandidate>& candidates,
                                          const CorrectedRobot& model, const Robot& robot, const Detection& detection) {
  std::vector<NotFound> all;
  std::vector<std::vector<CandidateSignal>> signals;  // one of each of `all`
  if (detection.null_maxima.empty()) return all;
  for (const DetectableCandidate& one : candidates) {
    const Effect& effect = one.candidate.effect;
    if (is_symbolic(effect)) continue;
    if (one.candidate.decoy_kind != DecoyKind::none || one.score.rank == 0 || holds_kind(model, effect)) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const NotFound& other) {
      return other.effect.kind == effect.kind && other.effect.joint == effect.joint;
    });
    const auto place = static_cast<std::size_t>(same - all.begin());
    if (same == all.end()) {
      all.push_back({effect, 0.0, law_of(effect).coefficients(effect, robot).front().unit});
      signals.emplace_back();
    } else if (effect.form != same->effect.form) {
      continue;
    }
    CandidateSignal signal = signal_of(one, robot, detection);
    if (!is_harmonic(effect.kind) || signal.own_share() >= kLeastOwn) signals[place].push_back(std::move(signal));
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].smallest_detectable = signals[i].empty() ? kUndetectable : detectable_amplitude(signals[i]);
  return all;
}

}  // namespace demecal::inline diagnosis
