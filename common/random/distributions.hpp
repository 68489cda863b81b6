// Shares and quantiles of the distributions that judgements rest on, by Boost.Math; medians, and how sure they are.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace demecal::inline random {
/// P(F > ratio) of Fisher's F with `above` and `below` degrees of freedom; ratio >= 0.
double fisher_p_value(double ratio, double above, double below);
/// The ratio that Fisher's F stays below with probability `share`.
double fisher_quantile(double share, double above, double below);

/// The length that a vector of `axes` independent standard normal numbers stays below with probability `share`: the
/// root of the quantile of chi-square.
double normal_length_quantile(int axes, double share);

/// The same for many calls, of 24 bits, in which the C libraries of all machines agree: thresholds of fits.
class NormalLengths {
 public:
  explicit NormalLengths(double share);
  double operator()(int axes) const;

 private:
  double share_;
  std::array<float, 12> of_axes_{};  ///< from 1 on
};

/// The probability that a median lies between the value number `rank` (from 0) of a sample of `count`, in order, and
/// the one as far from the end: how many values lie below the median is binomial with 1/2.
double median_coverage(std::size_t count, std::size_t rank);

/// The upper one of the two middle values where there are as many below as above. There must be a value.
double median(std::vector<double> values);
/// Of all values in order that at the place share * (count - 1), rounded down. There must be a value.
double quantile(std::vector<double> values, double share);
/// Not a number where there are no values.
double mean(const std::vector<double>& values);

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

}  // namespace demecal::inline random
