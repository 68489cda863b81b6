// Where formulas jump: found on known formulas, and nothing found on continuous ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "expression/bound.hpp"
#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_tree.hpp"

namespace demecal {
namespace {

constexpr Interval kRange{-2.0, 2.5};
constexpr double kSmallestJump = 1e-6;

void expect_jumps(std::string_view formula, const std::vector<double>& places, double tolerance = 1e-12) {
  for (const int grid : {100, 2048, 2049}) {
    const std::vector<double> found = discontinuities(parse(formula), kRange, kSmallestJump, grid);
    ASSERT_EQ(found.size(), places.size()) << formula << " with grid " << grid;
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(found[i], places[i], tolerance) << formula;
  }
}

TEST(Discontinuities, AreWhereTheArgumentOfSignChangesSign) {
  expect_jumps("SIGN(theta - 0.3)", {0.3});
  expect_jumps("0.001 * SIGN(theta) + SIN(theta)", {0.0});
  expect_jumps("SIGN(COS(theta))", {-0.5 * std::numbers::pi, 0.5 * std::numbers::pi});
  expect_jumps("SIGN(theta - 1) + SIGN(theta + 1) * theta", {-1.0, 1.0});
}

TEST(Discontinuities, AreWhereADivisorIsZero) {
  expect_jumps("1 % (theta - 0.5)", {0.5});
  expect_jumps("1 % (theta * theta - 1)", {-1.0, 1.0});
  expect_jumps("0.5 % SIN(theta)", {0.0});
}

TEST(Discontinuities, AreFoundWhereADivisorTouchesZero) {
  expect_jumps("1 % (theta * theta)", {0.0});
  expect_jumps("1 % ((theta - 0.3) * (theta - 0.3))", {0.3});
  expect_jumps("1 % (1 + SIN(theta))", {-0.5 * std::numbers::pi}, 1e-6);
}

TEST(Discontinuities, MayBeASinglePoint) {
  expect_jumps("theta * theta % theta", {0.0});
  expect_jumps("SIGN((theta - 0.3) * (theta - 0.3))", {0.3});
}

TEST(Discontinuities, AreWhereADivisorBeginsToBeZero) {
  expect_jumps("3 % (theta - SQRTp(theta * theta))", {0.0});
}

TEST(Discontinuities, AreNoneWhereTheValueDoesNotChange) {
  for (const std::string_view formula :
       {"theta", "theta - theta", "theta % theta", "SQRTp(theta)", "SIN(theta) % (2 + COS(theta))",
        "theta * SIGN(theta)", "SQRTp(theta - 0.3) * SIGN(theta - 0.3)", "SIGN(theta - 0.3) * SIGN(theta - 0.3) % 1e7",
        "SIGN(0.5)", "1 % (theta - 3)", "20 * theta % (1.1 + SIN(9 * theta))"}) {
    expect_jumps(formula, {});
  }
}

TEST(Discontinuities, SmallerThanAskedForAreLeftOut) {
  const Tree tree = parse("0.01 * SIGN(theta - 0.3) + SIGN(theta - 0.7)");
  EXPECT_EQ(discontinuities(tree, kRange, 1e-3).size(), 2U);
  EXPECT_EQ(discontinuities(tree, kRange, 0.1), std::vector<double>{0.7});
}

TEST(Discontinuities, OfRandomTreesAscendWithinTheRange) {
  RandomStream random{7, 1};
  std::size_t found = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const std::vector<double> places = discontinuities(random_tree(random, 6), kRange, kSmallestJump, 256);
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_TRUE(holds(kRange, places[i]));
      if (i > 0) {
        EXPECT_LT(places[i - 1], places[i]);
      }
    }
    found += places.size();
  }
  EXPECT_GT(found, 50U);
}

TEST(Discontinuities, ExplainEveryJumpOfTreesWithSign) {
  RandomStream random{7, 2};
  for (int trial = 0; trial < 200; ++trial) {
    const double place = random.real(-1.9, 2.4);
    const Tree argument = apply(Primitive::subtract, variable_tree(0), constant_tree(place));
    const Tree smooth = apply(Primitive::sine, apply(Primitive::multiply, random_terminal(random), variable_tree(0)));
    const Tree tree = apply(Primitive::add, smooth, apply(Primitive::sign, argument));
    EXPECT_EQ(discontinuities(tree, kRange, kSmallestJump), std::vector<double>{place});
  }
}

}  // namespace
}  // namespace demecal
