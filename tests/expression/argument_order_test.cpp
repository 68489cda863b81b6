// Formulas that differ in the order of arguments alone become one, and keep their values.
#include "expression/argument_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_function.hpp"

namespace demecal {
namespace {

TEST(InOrder, IsTheSameForFormulasThatDifferInTheOrderOfArguments) {
  RandomStream random{811};
  int different = 0;
  for (int i = 0; i < 3000; ++i) {
    const Tree tree = random_tree(random, 6, 2), other = swapped(random, tree);
    ASSERT_EQ(in_order(tree), in_order(other)) << to_text(tree, {"x", "y"});
    different += tree != other ? 1 : 0;
  }
  EXPECT_GT(different, 1000);
}

TEST(InOrder, KeepsValuesToTheBitAndChangesNothingTwice) {
  RandomStream random{812};
  for (int i = 0; i < 3000; ++i) {
    const Tree tree = random_tree(random, 6), ordered = in_order(tree);
    ASSERT_EQ(ordered.size(), tree.size());
    ASSERT_EQ(in_order(ordered), ordered);
    for (int k = 0; k < 5; ++k) {
      const double theta[] = {random.real(-3.0, 3.0)};
      const double before = evaluate(tree, theta), after = evaluate(ordered, theta);
      ASSERT_TRUE(before == after || (std::isnan(before) && std::isnan(after))) << to_text(tree);
    }
  }
}

TEST(InOrder, AddsTheNegativeOfAConstant) {
  EXPECT_EQ(in_order(parse("theta - 0.25")), in_order(parse("-0.25 + theta")));
  EXPECT_NE(in_order(parse("0.25 - theta")), in_order(parse("theta - 0.25")));
  EXPECT_NE(in_order(parse("theta % 2")), in_order(parse("2 % theta")));
}

TEST(Precedes, IsATotalOrder) {
  RandomStream random{813};
  for (int i = 0; i < 3000; ++i) {
    const Tree a = random_tree(random, 2), b = random_tree(random, 2), c = random_tree(random, 2);
    EXPECT_EQ(int{precedes(a, b)} + int{precedes(b, a)}, a == b ? 0 : 1);
    if (precedes(a, b) && precedes(b, c)) {
      EXPECT_TRUE(precedes(a, c));
    }
  }
}

}  // namespace
}  // namespace demecal
