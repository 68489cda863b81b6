#include "fitting/median.hpp"

#include <algorithm>
#include <cmath>

#include "errors/check.hpp"

namespace demecal {
namespace {

/// Probabilities that the median lies between the value number `rank`, from 0, and the one as far from the end.
class Coverage {
 public:
  explicit Coverage(std::size_t count) : count_(static_cast<double>(count)), log_share_(-count_ * std::log(2.0)) {}

  /// Of the first rank, then of every next one.
  double next() {
    below_ += std::exp(log_share_);
    log_share_ += std::log((count_ - rank_) / (rank_ + 1.0));
    rank_ += 1.0;
    return 1.0 - 2.0 * below_;
  }

 private:
  double count_;
  double rank_ = 0.0;
  double log_share_;  ///< of exactly rank_ values below the median
  double below_ = 0.0;
};

}  // namespace

double median(std::vector<double> values) {
  DEMECAL_CHECK(!values.empty(), "the median of nothing");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

MedianInterval median_interval(std::vector<double> values, double confidence) {
  DEMECAL_CHECK(!values.empty(), "the median of nothing");
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  MedianInterval interval{0.5 * (values[(count - 1) / 2] + values[count / 2]), values.front(), values.back(), {}};
  Coverage coverage(count);
  for (std::size_t rank = 0; 2 * rank + 1 < count; ++rank) {
    const double probability = coverage.next();
    if (probability < confidence) break;
    interval = {interval.median, values[rank], values[count - 1 - rank], probability};
  }
  return interval;
}

std::size_t least_for_interval(double confidence) {
  DEMECAL_CHECK(confidence < 1.0, "confidence=" << confidence);
  std::size_t count = 2;
  while (Coverage(count).next() < confidence) ++count;
  return count;
}

}  // namespace demecal
