// Our sine and cosine against the C library's in wider numbers.
#include "expression/sine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

// Distance of `value` from `exact` in units of the last place of `exact`.
double units_off(double value, long double exact) {
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, 2.0) - size;
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

}  // namespace
}  // namespace demecal
