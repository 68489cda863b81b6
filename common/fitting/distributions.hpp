// Shares and quantiles of the distributions that judgements rest on, by Boost.Math.
#pragma once

#include <cstddef>

namespace demecal::inline fitting {

/// P(F > ratio) of Fisher's F with `above` and `below` degrees of freedom; ratio >= 0.
double fisher_p_value(double ratio, double above, double below);
/// The ratio that Fisher's F stays below with probability `share`.
double fisher_quantile(double share, double above, double below);

/// The length that a vector of `axes` independent standard normal numbers stays below with probability `share`: the
/// root of the quantile of chi-square.
double normal_length_quantile(int axes, double share);

/// The probability that a median lies between the value number `rank` (from 0) of a sample of `count`, in order, and
/// the one as far from the end: how many values lie below the median is binomial with 1/2.
double median_coverage(std::size_t count, std::size_t rank);

}  // namespace demecal::inline fitting
