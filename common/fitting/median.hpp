// The middle of many numbers, and how sure it is.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace demecal::inline fitting {

/// The upper one of the two middle values where there are as many below as above. There must be a value.
double median(std::vector<double> values);

/// `lower` to `upper` holds the median of what the sample was drawn from with probability `confidence`; where that is
/// nothing, they are the least and the largest value, since the sample is too small for the confidence asked for.
struct MedianInterval {
  double median = 0.0;  ///< the mean of the middle two where there are as many below as above
  double lower = 0.0, upper = 0.0;
  std::optional<double> confidence;
};

/// The interval between the innermost two order statistics, as far from either end, whose probability is at least
/// `confidence` whatever the distribution (how many of n values lie below the median is binomial with 1/2). There must
/// be a value, and all must be finite.
MedianInterval median_interval(std::vector<double> values, double confidence = 0.95);

/// The least number of values for which there is such an interval: 6 for 0.95.
std::size_t least_for_interval(double confidence = 0.95);

}  // namespace demecal::inline fitting
