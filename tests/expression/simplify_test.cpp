// Simplified formulas have the values of what they came from, and are shorter.
#include "expression/simplify.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

// Not a number where a subtree is not finite.
double value_if_finite(const Tree& tree, double x, double y) {
  const auto checked = [](double value) { return std::isfinite(value) ? value : std::nan(""); };
  return fold<double>(
      tree,
      [&](const Node& node) {
        return node.primitive == Primitive::constant ? node.value : (node.variable == 0 ? x : y);
      },
      [&](Primitive function, double a) { return std::isnan(a) ? a : checked(value_of(function, a)); },
      [&](Primitive function, double a, double b) {
        return std::isnan(a) || std::isnan(b) ? std::nan("") : checked(value_of(function, a, b));
      });
}

// Random trees seldom hold what can be simplified: these repeat subtrees and take 0 and 1 as constants.
Tree redundant_tree(RandomStream& random, int depth) {
  if (depth == 0) {
    const double constants[]{0.0, 1.0, 2.0, -1.0};
    return random.chance(0.4) ? constant_tree(constants[random.index(4)]) : random_terminal(random, 2);
  }
  const PrimitiveTraits& function = kPrimitives[2 + random.index(kPrimitives.size() - 2)];
  const Tree first = redundant_tree(random, depth - 1);
  if (function.arity == 1) return apply(function.primitive, first);
  return apply(function.primitive, first, random.chance(0.3) ? first : redundant_tree(random, depth - 1));
}

TEST(Simplified, KeepsEveryValueOnTheDataAndIsNeverLonger) {
  RandomStream random{101};
  int shorter = 0, compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Tree tree = redundant_tree(random, 1 + static_cast<int>(random.index(5)));
    const Tree simple = simplified(tree);
    ASSERT_TRUE(is_valid(simple, 2));
    ASSERT_LE(simple.size(), tree.size());
    ASSERT_EQ(simplified(simple).size(), simple.size()) << to_string(tree, {"x", "y"});
    shorter += simple.size() < tree.size();
    for (int row = 0; row < 20; ++row) {
      const double point[]{row == 0 ? 0.0 : random.real(-3.0, 3.0), row < 2 ? 0.0 : random.real(-3.0, 3.0)};
      const double expected = value_if_finite(tree, point[0], point[1]);
      if (std::isnan(expected)) continue;
      ASSERT_EQ(evaluate(simple, point), expected) << to_string(tree, {"x", "y"});
      ++compared;
    }
  }
  EXPECT_GT(shorter, 1000);
  EXPECT_GT(compared, 30000);
}

TEST(Simplified, KnowsTheProtectedOperators) {
  const auto simple = [](const char* text) { return to_string(simplified(parse(text))); };
  EXPECT_EQ(simple("theta % theta"), "1");
  EXPECT_EQ(simple("SIN(theta) % (theta - theta)"), "1");
  EXPECT_EQ(simple("0 % theta"), "0 % theta");
  EXPECT_EQ(simple("theta - theta"), "0");
  EXPECT_EQ(simple("SQRTp(ABS(theta)) * 1 + 0 * SIN(theta)"), "SQRTp(theta)");
  EXPECT_EQ(simple("SIN(theta) + SIN(theta)"), "2 * SIN(theta)");
  EXPECT_EQ(simple("ABS(theta * theta)"), "theta * theta");
}

TEST(Simplified, LeavesConstantsThatOverflow) {
  const Tree huge = apply(Primitive::multiply, constant_tree(1e200), constant_tree(1e200));
  EXPECT_EQ(simplified(huge), huge);
}

TEST(Collected, GathersTermsAndConstants) {
  const auto simple = [](const char* text) { return to_string(collected(parse(text))); };
  EXPECT_EQ(simple("2 * theta + theta * 3"), "5 * theta");
  EXPECT_EQ(simple("theta + 1 + theta + 2 - theta"), "theta + 3");
  EXPECT_EQ(simple("2 * SIN(theta) - 5 * SIN(theta)"), "-3 * SIN(theta)");
  EXPECT_EQ(simple("2 * (theta + 1) - 2 * theta"), "2");
  EXPECT_EQ(simple("0.5 * SIN(theta) + 0.5 * COS(theta)"), "0.5 * (SIN(theta) + COS(theta))");
  EXPECT_EQ(simple("SIN(theta + theta + theta) + theta % 2 + theta % 2"), "SIN(3 * theta) + theta");
  EXPECT_EQ(simple("2 * theta * (3 * COS(theta))"), "6 * (theta * COS(theta))");
  EXPECT_EQ(simple("4 - theta - theta - theta"), "4 - 3 * theta");
}

TEST(Collected, KeepsToTheProtectedQuotient) {
  const auto simple = [](const char* text) { return to_string(collected(parse(text))); };
  // Where theta is 0 these are 1 times the factor, 1, and 2.
  for (const char* text : {"3 * (theta % SIN(theta))", "(3 * theta) % theta", "1 % theta + 1 % SIN(theta)"})
    EXPECT_EQ(collected(parse(text)), parse(text));
  EXPECT_EQ(simple("theta % 0 + theta % 0"), "2");
}

TEST(Collected, KeepsValuesToRoundingAndIsNeverLonger) {
  RandomStream random{102};
  int shorter = 0, compared = 0, exact = 0;
  for (int i = 0; i < 3000; ++i) {
    const Tree tree = redundant_tree(random, 1 + static_cast<int>(random.index(5)));
    std::vector<std::vector<double>> columns(2, std::vector<double>(20));
    for (auto& column : columns)
      for (std::size_t row = 0; row < column.size(); ++row) column[row] = row == 0 ? 0.0 : random.real(-3.0, 3.0);
    const Tree simple = simplified_over(tree, columns);
    ASSERT_TRUE(is_valid(simple, 2));
    ASSERT_LE(collected(tree).size(), simplified(tree).size()) << to_string(tree, {"x", "y"});
    ASSERT_LE(simple.size(), tree.size());
    shorter += simple.size() < simplified(tree).size();
    exact += simple.size() > collected(tree).size();
    double largest = 0.0;
    std::vector<double> expected;
    for (std::size_t row = 0; row < 20; ++row) {
      expected.push_back(value_if_finite(tree, columns[0][row], columns[1][row]));
      if (!std::isnan(expected.back())) largest = std::max(largest, std::abs(expected.back()));
    }
    for (std::size_t row = 0; row < 20; ++row) {
      if (std::isnan(expected[row])) continue;
      const double point[]{columns[0][row], columns[1][row]};
      ASSERT_NEAR(evaluate(simple, point), expected[row], 1e-9 * largest) << to_string(tree, {"x", "y"});
      ++compared;
    }
  }
  EXPECT_GT(shorter, 25);
  EXPECT_LT(exact, 100);
  EXPECT_GT(compared, 50000);
}

}  // namespace
}  // namespace demecal
