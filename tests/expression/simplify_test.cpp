// Simplified formulas have the values of what they came from, and are shorter.
#include "expression/simplify.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/fold.hpp"
#include "expression/text.hpp"
#include "random_tree.hpp"

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
    ASSERT_EQ(simplified(simple).size(), simple.size()) << to_text(tree, {"x", "y"});
    shorter += simple.size() < tree.size();
    for (int row = 0; row < 20; ++row) {
      const double point[]{row == 0 ? 0.0 : random.real(-3.0, 3.0), row < 2 ? 0.0 : random.real(-3.0, 3.0)};
      const double expected = value_if_finite(tree, point[0], point[1]);
      if (std::isnan(expected)) continue;
      ASSERT_EQ(evaluate(simple, point), expected) << to_text(tree, {"x", "y"});
      ++compared;
    }
  }
  EXPECT_GT(shorter, 1000);
  EXPECT_GT(compared, 30000);
}

TEST(Simplified, KnowsTheProtectedOperators) {
  const auto simple = [](const char* text) { return to_text(simplified(parse(text))); };
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

}  // namespace
}  // namespace demecal
