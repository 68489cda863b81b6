#include "fitting/distributions.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

namespace demecal::inline fitting {

double fisher_p_value(double ratio, double above, double below) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(above, below), ratio));
}

double fisher_quantile(double share, double above, double below) {
  return boost::math::quantile(boost::math::fisher_f(above, below), share);
}

double normal_length_quantile(int axes, double share) {
  return std::sqrt(boost::math::quantile(boost::math::chi_squared(axes), share));
}

double median_coverage(std::size_t count, std::size_t rank) {
  return 1.0 -
         2.0 * boost::math::cdf(boost::math::binomial(static_cast<double>(count), 0.5), static_cast<double>(rank));
}

}  // namespace demecal::inline fitting
