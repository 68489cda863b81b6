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

TEST(Sine, IsWithinThreeUnitsInTheLastPlace) {
  RandomStream random{2, 1};
  for (const double largest : {0.01, 1.0, 4.0, 100.0, 1e4, 1.04e6}) {
    for (int trial = 0; trial < 20000; ++trial) EXPECT_LT(worst_units_off(random.real(-largest, largest)), 3.0);
  }
}

TEST(Sine, IsWithinThreeUnitsInTheLastPlaceBesideItsZerosAndCrests) {
  for (int quarter_turns = -60000; quarter_turns < 60000; ++quarter_turns) {
    const double angle = quarter_turns * 0.5 * std::numbers::pi;
    EXPECT_LT(worst_units_off(angle), 3.0) << quarter_turns;
    EXPECT_LT(worst_units_off(std::nextafter(angle, 1e9)), 3.0) << quarter_turns;
    EXPECT_LE(std::abs(sine(angle)), 1.0);
    EXPECT_LE(std::abs(cosine(angle)), 1.0);
  }
}

TEST(Sine, IsExactAtZero) {
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Sine, AsksTheLibraryBeyondTheReducedAngles) {
  for (const double angle : {1.1e6, -3e9, 1e300}) {
    EXPECT_EQ(sine(angle), std::sin(angle));
    EXPECT_EQ(cosine(angle), std::cos(angle));
  }
  EXPECT_TRUE(std::isnan(sine(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(cosine(std::nan(""))));
}

}  // namespace
}  // namespace demecal
