#include "random/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "errors/check.hpp"

namespace demecal::inline random {
double fisher_p_value(double ratio, double above, double below) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(above, below), ratio));
}

double fisher_quantile(double share, double above, double below) {
  return boost::math::quantile(boost::math::fisher_f(above, below), share);
}

double normal_length_quantile(int axes, double share) {
  return std::sqrt(boost::math::quantile(boost::math::chi_squared(axes), share));
}

NormalLengths::NormalLengths(double share) : share_(share) {
  int axes = 0;
  for (float& length : of_axes_) length = static_cast<float>(normal_length_quantile(++axes, share));
}

double NormalLengths::operator()(int axes) const {
  const auto place = static_cast<std::size_t>(axes - 1);
  return place < of_axes_.size() ? of_axes_[place] : static_cast<float>(normal_length_quantile(axes, share_));
}

double median_coverage(std::size_t count, std::size_t rank) {
  return 1.0 -
         2.0 * boost::math::cdf(boost::math::binomial(static_cast<double>(count), 0.5), static_cast<double>(rank));
}

double median(std::vector<double> values) {
  DEMECAL_CHECK(!values.empty(), "the median of nothing");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double quantile(std::vector<double> values, double share) {
  DEMECAL_CHECK(!values.empty(), "a quantile of nothing");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

MedianInterval median_interval(std::vector<double> values, double confidence) {
  DEMECAL_CHECK(!values.empty(), "the median of nothing");
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  MedianInterval interval{0.5 * (values[(count - 1) / 2] + values[count / 2]), values.front(), values.back(), {}};
  for (std::size_t rank = 0; 2 * rank + 1 < count; ++rank) {
    const double probability = median_coverage(count, rank);
    if (probability < confidence) break;
    interval = {interval.median, values[rank], values[count - 1 - rank], probability};
  }
  return interval;
}

std::size_t least_for_interval(double confidence) {
  DEMECAL_CHECK(confidence < 1.0, "confidence=" << confidence);
  std::size_t count = 2;
  while (median_coverage(count, 0) < confidence) ++count;
  return count;
}

}  // namespace demecal::inline random
