// The elementary functions: accuracy, bounds, symmetry, and the same bits on every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "primitives/elementary.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

// Distance of `value` from `exact` in units of the last place of `exact`.
double units_off(double value, long double exact) {
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::abs(exact - static_cast<long double>(value))) / unit;
}

double worst_units_off(double angle) {
  const auto wide = static_cast<long double>(angle);
  return std::max(units_off(sine(angle), std::sin(wide)), units_off(cosine(angle), std::cos(wide)));
}

constexpr double kStatedUnits = 1.6;

TEST(Sine, IsAsNearAsStated) {
  RandomStream random{2, 1};
  double worst = 0.0;
  for (const double largest : {0.01, 1.0, 1.6, 4.0, 100.0, 1e4, 1.04e6}) {
    for (int trial = 0; trial < 20000; ++trial)
      worst = std::max(worst, worst_units_off(random.real(-largest, largest)));
  }
  EXPECT_LT(worst, kStatedUnits);
  EXPECT_GT(worst, 1.0);  // the statement is not loose
}

TEST(Sine, IsAsNearAsStatedBesideItsZerosAndCrests) {
  double worst = 0.0;
  for (int quarter_turns = -60000; quarter_turns < 60000; ++quarter_turns) {
    const double angle = quarter_turns * 0.5 * std::numbers::pi;
    for (const double beside : {angle, std::nextafter(angle, 1e9), std::nextafter(angle, -1e9)}) {
      worst = std::max(worst, worst_units_off(beside));
      ASSERT_LE(std::abs(sine(beside)), 1.0);
      ASSERT_LE(std::abs(cosine(beside)), 1.0);
    }
  }
  EXPECT_LT(worst, kStatedUnits);
}

TEST(Sine, IsAsNearAsStatedForLargeAngles) {
  RandomStream random{2, 2};
  double worst = 0.0;
  for (int exponent = 20; exponent < 1023; ++exponent) {
    for (int trial = 0; trial < 50; ++trial)
      worst = std::max(worst, worst_units_off(std::ldexp(random.real(1.0, 2.0), exponent)));
  }
  EXPECT_LT(worst, kStatedUnits);
  // The double that comes nearest to a multiple of pi/2 (Muller, Elementary Functions, 2016).
  EXPECT_LT(worst_units_off(6381956970095103.0 * 0x1.0p797), kStatedUnits);
}

TEST(Sine, IsOddAndCosineEven) {
  RandomStream random{2, 3};
  for (const double largest : {1.0, 1e3, 1e12}) {
    for (int trial = 0; trial < 1000; ++trial) {
      const double angle = random.real(0.0, largest);
      EXPECT_EQ(sine(-angle), -sine(angle));
      EXPECT_EQ(cosine(-angle), cosine(angle));
    }
  }
}

TEST(Sine, IsExactAtZero) {
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Sine, IsNoNumberWhereTheAngleIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double angle : {infinity, -infinity, std::nan("")}) {
    EXPECT_TRUE(std::isnan(sine(angle)));
    EXPECT_TRUE(std::isnan(cosine(angle)));
  }
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
