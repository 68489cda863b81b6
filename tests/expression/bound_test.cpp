// Bounds hold every value that formulas take, and jumps are found where they are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "expression/bound.hpp"
#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Interval bound_of(std::string_view formula, Interval range, int pieces = 256) {
  return bound(parse(formula), range, pieces);
}

void expect_near(const Interval& actual, double lower, double upper, double tolerance) {
  EXPECT_NEAR(actual.lower, lower, tolerance);
  EXPECT_NEAR(actual.upper, upper, tolerance);
}

double sample(RandomStream& random, const Interval& range) {
  const double chosen[] = {range.lower, range.upper, 0.0, 0.5, random.real(range.lower, range.upper)};
  const double theta = chosen[random.chance(0.8) ? 4 : random.index(5)];
  return holds(range, theta) ? theta : range.lower;
}

TEST(Bound, HoldsEverySampledValueOfRandomTrees) {
  RandomStream random{6, 1};
  int finite = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Tree tree = random_tree(random, 6);
    const double lower = random.chance(0.2) ? 0.0 : random.real(-4.0, 4.0);
    const Interval range{lower, lower + random.real(0.0, random.chance(0.5) ? 0.1 : 5.0)};
    const Interval values = bound(tree, range, 1 + static_cast<int>(random.index(20)));
    finite += std::isfinite(values.upper - values.lower);
    for (int i = 0; i < 100; ++i) {
      const double theta = sample(random, range);
      const double value = evaluate(tree, {&theta, 1});
      EXPECT_TRUE(!std::isfinite(value) || holds(values, value)) << to_string(tree) << " at " << theta;
    }
  }
  EXPECT_GT(finite, 1000);
}

TEST(Bound, HoldsEveryValueOfEachPrimitiveOverRandomIntervals) {
  RandomStream random{6, 2};
  const auto interval = [&] {
    const double scale = std::pow(10.0, random.real(-3.0, 3.0));
    const double lower = random.real(-scale, scale);
    return Interval{lower, lower + random.real(0.0, scale)};
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const Interval a = interval();
    const Interval b = interval();
    for (const PrimitiveTraits& function : kPrimitives) {
      for (int i = 0; i < 10; ++i) {
        const double x = sample(random, a);
        const double y = sample(random, b);
        if (function.arity == 1) {
          EXPECT_TRUE(holds(image(function.primitive, a), value_of(function.primitive, x)));
        }
        if (function.arity == 2) {
          EXPECT_TRUE(holds(image(function.primitive, a, b), value_of(function.primitive, x, y)));
          EXPECT_TRUE(holds(image_of_twins(function.primitive, a), value_of(function.primitive, x, x)));
        }
      }
    }
  }
}

TEST(Bound, OfWavesIsTheirRange) {
  expect_near(bound_of("SIN(theta)", {0.2, 1.0}, 1), std::sin(0.2), std::sin(1.0), 1e-14);
  expect_near(bound_of("SIN(theta)", {1.0, 2.0}, 1), std::sin(1.0), 1.0, 1e-14);
  expect_near(bound_of("SIN(theta)", {4.0, 5.0}, 1), -1.0, std::sin(4.0), 1e-14);
  expect_near(bound_of("COS(theta)", {-0.5, 0.2}, 1), std::cos(0.5), 1.0, 1e-14);
  expect_near(bound_of("COS(theta)", {3.0, 3.5}, 1), -1.0, std::cos(3.5), 1e-14);
  expect_near(bound_of("COS(theta)", {100.0, 200.0}, 1), -1.0, 1.0, 0.0);
  expect_near(bound_of("COS(theta * 1e9)", {1.0, 1.1}, 1), -1.0, 1.0, 0.0);
}

TEST(Bound, TightensWithMorePieces) {
  const Interval range{0.0, 1.0};
  double width = kInfinity;
  for (const int pieces : {1, 4, 16, 64, 256}) {
    const Interval values = bound_of("theta * (1 - theta)", range, pieces);
    EXPECT_LT(values.upper - values.lower, width);
    width = values.upper - values.lower;
  }
  expect_near(bound_of("theta * (1 - theta)", range), 0.0, 0.25, 0.005);
}

TEST(Bound, IsInfiniteWhereADivisorMayPassThroughZero) {
  EXPECT_EQ(bound_of("1 % (theta - 0.5)", {0.0, 1.0}), unbounded());
  EXPECT_EQ(magnitude_bound(parse("1 % (theta * theta)"), {0.0, 1.0}), kInfinity);
  expect_near(bound_of("1 % theta", {0.5, 1.0}), 1.0, 2.0, 1e-12);
  expect_near(bound_of("SIN(1 % theta)", {-1.0, 1.0}), -1.0, 1.0, 0.0);
}

TEST(Bound, KnowsThatEqualSubtreesCancel) {
  const Interval range{-1.0, 1.0};
  EXPECT_EQ(bound(neutral_tree(), range), (Interval{0.0, 0.0}));
  EXPECT_EQ(bound_of("theta % theta", range), (Interval{1.0, 1.0}));
  EXPECT_EQ(bound_of("SIN(theta) % SIN(theta)", range), (Interval{1.0, 1.0}));
  EXPECT_EQ(bound_of("theta % (theta - theta)", range), (Interval{1.0, 1.0}));
  EXPECT_EQ(bound_of("(theta - theta) % theta", range), (Interval{0.0, 1.0}));
  expect_near(bound_of("theta * theta", range, 1), 0.0, 1.0, 1e-12);
}

TEST(Bound, OfAConstantIsItsValue) {
  const double value = 0.3 - 0.1 * 3.0 + std::sqrt(2.0);
  EXPECT_EQ(bound_of("0.3 - 0.1 * 3 + SQRTp(2)", {0.0, 1.0}), (Interval{value, value}));
}

TEST(Bound, OfSizeIsTheLargestAbsoluteValue) {
  EXPECT_NEAR(magnitude_bound(parse("theta - 3"), {0.0, 1.0}), 3.0, 1e-12);
  EXPECT_NEAR(magnitude_bound(parse("theta + 3"), {0.0, 1.0}), 4.0, 1e-12);
}

// The 256 pieces are those that the most halvings give.
TEST(StaysWithin, SaysWhatTheBoundOnAllPiecesSays) {
  RandomStream random{6, 3};
  int inside = 0, outside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Tree tree = random_tree(random, 6);
    const Interval range{random.real(-4.0, 0.0), random.real(0.0, 4.0)};
    const double size = magnitude_bound(tree, range);
    const double largest = random.real(0.0, 3.0);
    if (std::abs(size - largest) <= 1e-9 * largest) continue;
    ASSERT_EQ(stays_within(tree, range, largest), size < largest) << to_string(tree);
    (size < largest ? inside : outside) += 1;
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

TEST(StaysWithin, RefusesPolesWhateverTheLimit) {
  EXPECT_FALSE(stays_within(parse("1 % (theta - 0.3)"), {0.0, 1.0}, 1e300));
  EXPECT_TRUE(stays_within(parse("1 % (theta + 0.3)"), {0.0, 1.0}, 4.0));
}

TEST(Bound, AcceptsARangeOfOnePoint) {
  expect_near(bound_of("SQRTp(theta) + 1", {4.0, 4.0}), 3.0, 3.0, 0.0);
}

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
