// Where values stand in a chart, and which are written beside it.
#include "html/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

Axis random_axis(RandomStream& random, bool logarithmic) {
  const double size = std::pow(10.0, random.real(-6.0, 6.0));
  const double lower = logarithmic ? size : size * random.real(-3.0, 3.0);
  const double upper =
      logarithmic ? lower * std::pow(10.0, random.real(0.01, 12.0)) : lower + size * random.real(0.1, 2.0);
  return {lower, upper, 300.0, 20.0, logarithmic};
}

TEST(Axis, TakesItsEndsToTheEndsOfThePictureAndKeepsTheOrder) {
  RandomStream random{421};
  for (int trial = 0; trial < 200; ++trial) {
    const Axis axis = random_axis(random, trial % 2 == 0);
    EXPECT_NEAR(axis(axis.lower), axis.from_px, 1e-9);
    EXPECT_NEAR(axis(axis.upper), axis.to_px, 1e-9);
    const double a = random.real(axis.lower, axis.upper), b = random.real(axis.lower, axis.upper);
    EXPECT_EQ(axis(a) > axis(b), a < b);
  }
}

TEST(Axis, ShowsEqualRatiosAsEqualLengthsWhereLogarithmic) {
  const Axis axis{0.1, 1000.0, 0.0, 400.0, true};
  EXPECT_NEAR(axis(1.0), 100.0, 1e-9);
  EXPECT_NEAR(axis(10.0), 200.0, 1e-9);
  EXPECT_NEAR(axis(0.0), 0.0, 1e-9);
  EXPECT_NEAR(axis(-5.0), 0.0, 1e-9);
}

TEST(Ticks, AscendWithinTheAxisAndAreNeitherTooFewNorTooMany) {
  RandomStream random{422};
  for (int trial = 0; trial < 400; ++trial) {
    const Axis axis = random_axis(random, trial % 2 == 0);
    const std::vector<double> found = ticks(axis, 5);
    EXPECT_GE(found.size(), 2u) << axis.lower << " to " << axis.upper;
    EXPECT_LE(found.size(), 10u) << axis.lower << " to " << axis.upper;
    EXPECT_TRUE(std::ranges::is_sorted(found));
    const double slack = 1e-9 * (axis.upper - axis.lower);
    EXPECT_GE(found.front(), axis.lower - slack);
    EXPECT_LE(found.back(), axis.upper + slack);
  }
}

TEST(Ticks, AreRoundNumbers) {
  EXPECT_EQ(ticks({0.0, 3.5, 0.0, 1.0, false}, 6), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(ticks({-0.7, 0.9, 0.0, 1.0, false}, 4), (std::vector<double>{-0.5, 0.0, 0.5}));
  EXPECT_EQ(ticks({1.8, 23.0, 0.0, 1.0, true}, 5), (std::vector<double>{2.0, 5.0, 10.0, 20.0}));
  EXPECT_EQ(tick_text(3 * 0.1), "0.3");
  EXPECT_EQ(tick_text(-0.0), "0");
}

}  // namespace
}  // namespace demecal
