// Formulas as prefix sequences: their parts and depth, validity, and the order of arguments.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

TEST(Tree, SubtreesOfAFunctionFillItsTreeExactly) {
  RandomStream random{1, 1};
  for (int trial = 0; trial < 300; ++trial) {
    const Tree tree = random_tree(random, 7);
    for (std::size_t i = 0; i < tree.size(); ++i) {
      std::size_t end = i + 1;
      for (int argument = 0; argument < arity(tree[i].primitive); ++argument) end = subtree_end(tree, end);
      EXPECT_EQ(end, subtree_end(tree, i));
    }
    EXPECT_EQ(subtree_end(tree, 0), tree.size());
  }
}

TEST(Tree, DepthCountsArcsToTheMostRemoteLeaf) {
  RandomStream random{1, 2};
  EXPECT_EQ(depth(variable_tree(0)), 0);
  EXPECT_EQ(depth(neutral_tree()), 1);
  for (int trial = 0; trial < 300; ++trial) {
    const Tree left = random_tree(random, 5);
    const Tree right = random_tree(random, 5);
    EXPECT_LE(depth(left), 5);
    EXPECT_EQ(depth(apply(Primitive::sine, left)), depth(left) + 1);
    EXPECT_EQ(depth(apply(Primitive::divide, left, right)), std::max(depth(left), depth(right)) + 1);
  }
}

TEST(Tree, RandomTreesAreValidAndNoPartOrExtensionOfThemIs) {
  RandomStream random{1, 3};
  for (int trial = 0; trial < 300; ++trial) {
    Tree tree = random_tree(random, 6, 3);
    EXPECT_TRUE(is_valid(tree, 3));
    for (std::size_t length = 0; length < tree.size(); ++length) {
      EXPECT_FALSE(is_valid(std::span<const Node>(tree).first(length), 3));
    }
    tree.push_back(Node{Primitive::constant, 0, 1.0});
    EXPECT_FALSE(is_valid(tree, 3));
  }
}

TEST(Tree, IsInvalidWithUnknownPrimitivesVariablesOrConstantsThatAreNotFinite) {
  EXPECT_TRUE(is_valid(variable_tree(1), 2));
  EXPECT_FALSE(is_valid(variable_tree(2), 2));
  EXPECT_FALSE(is_valid(constant_tree(std::numeric_limits<double>::infinity()), 1));
  EXPECT_FALSE(is_valid(constant_tree(std::nan("")), 1));
  EXPECT_FALSE(is_valid(Tree{Node{static_cast<Primitive>(10), 0, 0.0}}, 1));
}

TEST(Tree, EqualityIsToTheBit) {
  EXPECT_EQ(constant_tree(0.25), constant_tree(0.25));
  EXPECT_NE(constant_tree(0.0), constant_tree(-0.0));
  EXPECT_NE(constant_tree(1.0), constant_tree(std::nextafter(1.0, 2.0)));
  EXPECT_NE(variable_tree(0), variable_tree(1));
}

TEST(Tree, ContainsThePrimitivesItIsMadeOf) {
  const Tree tree = apply(Primitive::sine, neutral_tree());
  EXPECT_TRUE(contains(tree, Primitive::sine));
  EXPECT_TRUE(contains(tree, Primitive::subtract));
  EXPECT_FALSE(contains(tree, Primitive::constant));
}

TEST(Tree, MayBeDeeperThanAnyCallStack) {
  Tree tree(1'000'000, Node{Primitive::cosine, 0, 0.0});
  tree.push_back(Node{Primitive::variable, 0, 0.0});
  EXPECT_TRUE(is_valid(tree, 1));
  EXPECT_EQ(depth(tree), 1'000'000);
  EXPECT_EQ(subtree_end(tree, 0), tree.size());
}

TEST(Primitives, StandInTheTableWhereTheirNumberSays) {
  for (std::size_t i = 0; i < kPrimitives.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kPrimitives[i].primitive), i);
    EXPECT_EQ(kPrimitives[i].symbol.empty(), kPrimitives[i].arity == 0);
  }
}

TEST(InOrder, IsTheSameForFormulasThatDifferInTheOrderOfArguments) {
  RandomStream random{811};
  int different = 0;
  for (int i = 0; i < 3000; ++i) {
    const Tree tree = random_tree(random, 6, 2), other = swapped(random, tree);
    ASSERT_EQ(in_order(tree), in_order(other)) << to_string(tree, {"x", "y"});
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
      ASSERT_TRUE(before == after || (std::isnan(before) && std::isnan(after))) << to_string(tree);
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
