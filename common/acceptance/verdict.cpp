#include "acceptance/verdict.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "random/distributions.hpp"

namespace demecal::inline acceptance {
namespace {

/// P(at least `least` of `count` keep within the share's error): a binomial tail, by the beta distribution and so by
/// Fisher's F.
double at_least(std::size_t count, std::size_t least, double share) {
  if (least == 0) return 1.0;
  if (least > count) return 0.0;
  const auto a = static_cast<double>(least), b = static_cast<double>(count - least + 1);
  return fisher_p_value(a / b * (1.0 - share) / share, 2.0 * b, 2.0 * a);
}

/// The order statistic (from 1) that the share's error exceeds with probability 1 - confidence at most; count + 1 where
/// there is none.
std::size_t upper_rank(std::size_t count) {
  std::size_t lower = 1, upper = count + 1;
  while (lower < upper) {
    const std::size_t middle = (lower + upper) / 2;
    if (at_least(count, middle, kAcceptedShare) <= 1.0 - kConfidence) {
      upper = middle;
    } else {
      lower = middle + 1;
    }
  }
  return lower;
}

/// The order statistic (from 1) that exceeds the share's error with probability 1 - confidence at most; 0 where there
/// is none.
std::size_t lower_rank(std::size_t count) {
  std::size_t lower = 0, upper = count;
  while (lower < upper) {
    const std::size_t middle = (lower + upper + 1) / 2;
    if (at_least(count, middle, kAcceptedShare) >= kConfidence) {
      lower = middle;
    } else {
      upper = middle - 1;
    }
  }
  return lower;
}

double normal_upper_limit(std::span<const double> errors) {
  double squares = 0.0;
  for (const double error : errors) squares += error * error;
  // The root of the quantile of chi-square with as many degrees of freedom as errors.
  const double least = normal_length_quantile(static_cast<int>(errors.size()), 1.0 - kConfidence);
  const double limit = normal_length_quantile(1, kAcceptedShare) * std::sqrt(squares) / least;
  return std::max(limit, std::ranges::max(errors));
}

/// As in error_figures(): interpolated between order statistics.
double share_of(const std::vector<double>& ascending) {
  const double rank = kAcceptedShare * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], rank - static_cast<double>(below));
}

/// How many poses would decide if the share `beyond` of them lay beyond the limit.
std::optional<std::size_t> poses_needed(std::size_t now, double beyond, bool conforming) {
  constexpr std::size_t kMost = 100000;
  for (std::size_t count = now + 1; count <= kMost; count += 1 + count / 200) {
    const double far = beyond * static_cast<double>(count);
    const auto out = static_cast<std::size_t>(conforming ? std::ceil(far) : std::floor(far));
    const double tail = conforming ? at_least(count, count - out, kAcceptedShare)
                                   : 1.0 - at_least(count, count - out + 1, kAcceptedShare);
    if (tail <= 1.0 - kConfidence) return count;
  }
  return std::nullopt;
}

std::size_t count_beyond(const std::vector<double>& ascending, double limit) {
  return static_cast<std::size_t>(ascending.end() - std::ranges::upper_bound(ascending, limit));
}

}  // namespace

const char* to_string(Conformity verdict) {
  constexpr const char* kWords[] = {"conformity proved", "non-conformity proved", "undecided"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::size_t fewest_without_assumption() {
  return static_cast<std::size_t>(std::ceil(std::log(1.0 - kConfidence) / std::log(kAcceptedShare)));
}

Judgement judge(std::span<const double> errors_m, double tolerance_m, double instrument_m, double noise_m) {
  return judge(errors_m, errors_m, tolerance_m, instrument_m, noise_m);
}

Judgement judge(std::span<const double> errors_m, std::span<const double> means_m, double tolerance_m,
                double instrument_m, double noise_m) {
  Judgement judged{.tolerance_m = tolerance_m,
                   .lower_m = {},
                   .upper_m = {},
                   .guard_below_m = kCoverageFactor * instrument_m,
                   .guard_above_m = kCoverageFactor * std::hypot(instrument_m, noise_m),
                   .poses = errors_m.size()};
  DEMECAL_CHECK(errors_m.size() == means_m.size(), errors_m.size() << " and " << means_m.size());
  if (errors_m.empty()) return judged;
  std::vector<double> ascending(errors_m.begin(), errors_m.end()), means(means_m.begin(), means_m.end());
  std::ranges::sort(ascending);
  std::ranges::sort(means);
  DEMECAL_CHECK(std::isfinite(ascending.front()) && std::isfinite(ascending.back()), "an error that is no number");
  judged.error_m = share_of(ascending);
  judged.beyond = count_beyond(ascending, tolerance_m);
  const std::size_t upper = upper_rank(ascending.size()), lower = lower_rank(ascending.size());
  judged.assumes_normal = upper > ascending.size();
  judged.upper_m = judged.assumes_normal ? normal_upper_limit(ascending) : ascending[upper - 1];
  if (lower > 0) judged.lower_m = means[lower - 1];
  if (*judged.upper_m + judged.guard_below_m <= tolerance_m) {
    judged.verdict = Conformity::conformity;
  } else if (judged.lower_m && *judged.lower_m - judged.guard_above_m > tolerance_m) {
    judged.verdict = Conformity::non_conformity;
  }
  if (judged.poses < kFewestJudged)
    withhold(judged, fmt::format("so few prove nothing of others, {} at least are needed", kFewestJudged));
  return judged;
}

void withhold(Judgement& judged, std::string why) {
  if (judged.verdict != Conformity::conformity) return;
  judged.verdict = Conformity::undecided;
  judged.withheld = std::move(why);
}

std::optional<std::size_t> poses_to_decide(std::span<const double> errors_m, std::span<const double> means_m,
                                           const Judgement& judged) {
  if (judged.verdict != Conformity::undecided || errors_m.empty()) return std::nullopt;
  const auto share = [](std::span<const double> values, double limit) {
    const auto beyond = std::ranges::count_if(values, [limit](double error) { return error > limit; });
    return static_cast<double>(beyond) / static_cast<double>(values.size());
  };
  const double outside = share(errors_m, judged.tolerance_m - judged.guard_below_m);
  const double far = share(means_m, judged.tolerance_m + judged.guard_above_m);
  if (outside < 1.0 - kAcceptedShare) return poses_needed(errors_m.size(), outside, true);
  if (far > 1.0 - kAcceptedShare) return poses_needed(errors_m.size(), far, false);
  return std::nullopt;
}

}  // namespace demecal::inline acceptance
