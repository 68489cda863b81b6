// Bounds of formulas over a range: sound on random trees, and as tight as they should be on known ones.
#include "expression/bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expression/evaluate.hpp"
#include "expression/limit.hpp"
#include "expression/text.hpp"
#include "random_tree.hpp"

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
      EXPECT_TRUE(!std::isfinite(value) || holds(values, value)) << to_text(tree) << " at " << theta;
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
    ASSERT_EQ(stays_within(tree, range, largest), size < largest) << to_text(tree);
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

}  // namespace
}  // namespace demecal
