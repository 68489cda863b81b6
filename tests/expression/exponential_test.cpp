// Our exponential, logarithm, hyperbolic and arc tangent against the C library's in wider numbers.
#include "expression/exponential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

double units_off(double value, long double exact) {
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::abs(exact - static_cast<long double>(value))) / unit;
}

/// The worst over random arguments of all sizes up to the largest.
template <class Function, class Exact>
double worst_units_off(Function function, Exact exact, double largest, std::uint64_t seed) {
  RandomStream random{3, seed};
  double worst = 0.0;
  for (double size = largest; size > 1e-12; size *= 0.3) {
    for (int trial = 0; trial < 5000; ++trial) {
      const double x = random.real(-size, size);
      worst = std::max(worst, units_off(function(x), exact(static_cast<long double>(x))));
    }
  }
  return worst;
}

TEST(Exponential, IsAsNearAsStatedAndBounded) {
  EXPECT_LT(worst_units_off(
                bounded_exponential, [](long double x) { return std::exp(x); }, kLargestExponent, 1),
            2.0);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {kLargestExponent, 17.0, 1e300, infinity}) {
    EXPECT_EQ(bounded_exponential(x), bounded_exponential(kLargestExponent));
    EXPECT_EQ(bounded_exponential(-x), bounded_exponential(-kLargestExponent));
  }
  EXPECT_EQ(bounded_exponential(0.0), 1.0);
  EXPECT_TRUE(std::isnan(bounded_exponential(std::nan(""))));
}

TEST(Logarithm, IsAsNearAsStatedAndProtected) {
  const auto exact = [](long double x) { return std::log(std::abs(x)); };
  for (const double largest : {1e300, 2.0}) EXPECT_LT(worst_units_off(protected_logarithm, exact, largest, 2), 2.5);
  RandomStream random{3, 5};
  for (int trial = 0; trial < 20000; ++trial) {
    const double beside_one = 1.0 + random.real(-0.3, 0.3) * std::pow(10.0, random.real(-15.0, 0.0));
    EXPECT_LT(units_off(protected_logarithm(beside_one), exact(beside_one)), 2.5) << beside_one;
  }
  for (const double tiny : {5e-324, 1e-310, 2.3e-308})
    EXPECT_LT(units_off(protected_logarithm(tiny), exact(tiny)), 2.5);
  EXPECT_EQ(protected_logarithm(0.0), 0.0);
  EXPECT_EQ(protected_logarithm(1.0), 0.0);
  EXPECT_EQ(protected_logarithm(-7.5), protected_logarithm(7.5));
  EXPECT_FALSE(std::isfinite(protected_logarithm(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(protected_logarithm(std::nan(""))));
}

TEST(HyperbolicTangent, IsAsNearAsStatedAndWithinOne) {
  EXPECT_LT(worst_units_off(
                hyperbolic_tangent, [](long double x) { return std::tanh(x); }, 30.0, 3),
            3.0);
  for (const double x : {19.9, 20.1, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(hyperbolic_tangent(x), 1.0);
    EXPECT_EQ(hyperbolic_tangent(-x), -1.0);
  }
  EXPECT_EQ(hyperbolic_tangent(0.0), 0.0);
  EXPECT_TRUE(std::isnan(hyperbolic_tangent(std::nan(""))));
}

TEST(ArcTangent, IsAsNearAsStated) {
  const auto exact = [](long double x) { return std::atan(x); };
  for (const double largest : {1e300, 3.0}) EXPECT_LT(worst_units_off(arc_tangent, exact, largest, 4), 2.5);
  EXPECT_EQ(arc_tangent(0.0), 0.0);
  EXPECT_LE(arc_tangent(std::numeric_limits<double>::infinity()), 2.0 * arc_tangent(1.0));
  EXPECT_TRUE(std::isnan(arc_tangent(std::nan(""))));
}

}  // namespace
}  // namespace demecal
