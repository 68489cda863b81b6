// Random trees keep to their depths and sets of nodes, and equal ones are found.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "evolution/tree_generation.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"

namespace demecal {
namespace {

GpParameters with_constants_of_both_signs() {
  GpParameters parameters;
  parameters.constants_lower = -2.0;
  parameters.constants_upper = 3.0;
  return parameters;
}

TEST(Grow, GivesValidTreesAndTheirDepth) {
  RandomStream random{31};
  const NodeSet nodes = node_set(with_constants_of_both_signs(), 3);
  for (int trial = 0; trial < 4000; ++trial) {
    Tree tree;
    const int limit = trial % 10;
    const int grown = append_grown(random, nodes, limit, tree);
    ASSERT_TRUE(is_valid(tree, 3));
    ASSERT_EQ(grown, depth(tree));
    ASSERT_LE(grown, limit);
    for (const Node& node : tree) {
      if (node.primitive != Primitive::constant) continue;
      ASSERT_GE(node.value, -2.0);
      ASSERT_LT(node.value, 3.0);
    }
  }
}

TEST(Grow, DrawsTerminalsAndFunctionsAlike) {
  RandomStream random{32};
  const NodeSet nodes = node_set(GpParameters{}, 1);
  std::map<Primitive, int> roots;
  constexpr int kDraws = 20000;
  for (int trial = 0; trial < kDraws; ++trial) {
    Tree tree;
    append_grown(random, nodes, 1, tree);
    ++roots[tree.front().primitive];
  }
  EXPECT_EQ(roots.size(), 10u);
  for (const auto& [primitive, count] : roots) EXPECT_NEAR(count, kDraws / 10, 200) << static_cast<int>(primitive);
}

TEST(Grow, DrawsFunctionsByTheirWeights) {
  RandomStream random{35};
  GpParameters parameters;
  parameters.function_weights = {1.0, 2.0, 3.0, 4.0, 0.5, 0.5, 4.0, 5.0};
  const NodeSet nodes = node_set(parameters, 1);
  std::map<Primitive, int> grown, full;
  constexpr int kDraws = 20000;
  for (int trial = 0; trial < kDraws; ++trial) {
    Tree tree;
    append_grown(random, nodes, 1, tree);
    ++grown[tree.front().primitive];
    tree.clear();
    append_full(random, nodes, 1, tree);
    ++full[tree.front().primitive];
  }
  for (std::size_t i = 0; i < parameters.functions.size(); ++i) {
    const double share = parameters.function_weights[i] / 20.0;
    EXPECT_NEAR(full[parameters.functions[i]], share * kDraws, 250);
    EXPECT_NEAR(grown[parameters.functions[i]], 0.8 * share * kDraws, 250);
  }
  EXPECT_NEAR(grown[Primitive::variable], kDraws / 10, 200);
}

TEST(Full, HasAllLeavesAtItsDepth) {
  RandomStream random{33};
  const NodeSet nodes = node_set(GpParameters{}, 2);
  for (int trial = 0; trial < 1000; ++trial) {
    const int wanted = trial % 8;
    Tree tree;
    append_full(random, nodes, wanted, tree);
    ASSERT_TRUE(is_valid(tree, 2));
    std::vector<int> levels{0};
    for (const Node& node : tree) {
      const int level = levels.back();
      levels.pop_back();
      if (arity(node.primitive) == 0) {
        ASSERT_EQ(level, wanted);
      }
      levels.insert(levels.end(), static_cast<std::size_t>(arity(node.primitive)), level + 1);
    }
  }
}

std::vector<SharedFunction> two_functions() {
  return {parse_definition("F1(c1, c2, a1) = c1 * ATAN(c2 + a1)", 0),
          parse_definition("F2(a1, a2) = TANH(a1 * SQUARE(a1 + a2))", 1)};
}

GpParameters with_functions() {
  GpParameters parameters = with_constants_of_both_signs();
  parameters.shared_functions = two_functions();
  return parameters;
}

TEST(Calls, StandInValidTreesThatKeepToTheirDepth) {
  RandomStream random{391};
  const NodeSet nodes = node_set(with_functions(), 2);
  for (int trial = 0; trial < 4000; ++trial) {
    Tree grown, full;
    const int limit = trial % 10;
    const int came_to = append_grown(random, nodes, limit, grown);
    EXPECT_EQ(came_to, depth(grown));
    append_full(random, nodes, limit, full);
    for (const Tree& tree : {grown, full}) {
      ASSERT_TRUE(is_valid(tree, 2));
      ASSERT_LE(depth(tree), limit);
    }
  }
}

TEST(Calls, HaveNumbersInTheRangeOfConstantsAsCoefficients) {
  RandomStream random{392};
  GpParameters parameters = with_functions();
  parameters.functions = {Primitive::sine};  // what is neither sine nor terminal comes from a call
  const NodeSet nodes = node_set(parameters, 1);
  int calls = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Tree tree;
    append_grown(random, nodes, 6, tree);
    const FoldedFormula formula = folded(tree, parameters.shared_functions);
    EXPECT_TRUE(std::ranges::all_of(formula.outline, [](const Node& node) {
      return arity(node.primitive) == 0 || node.primitive == Primitive::sine;
    })) << to_string(formula);
    calls += static_cast<int>(formula.calls.size());
    for (const Node& node : tree) {
      if (node.primitive != Primitive::constant) continue;
      EXPECT_GE(node.value, -2.0);
      EXPECT_LT(node.value, 3.0);
    }
  }
  EXPECT_GT(calls, 300);
}

TEST(Calls, AreDrawnByTheirWeight) {
  GpParameters parameters = with_functions();
  for (const double weight : {0.25, 1.0, 4.0}) {
    for (const bool weighed : {false, true}) {
      RandomStream random{393};
      parameters.shared_function_weight = weight;
      parameters.function_weights.assign(weighed ? parameters.functions.size() : 0, 1.0);
      const NodeSet nodes = node_set(parameters, 1);
      int calls = 0;
      constexpr int kDraws = 20000;
      for (int trial = 0; trial < kDraws; ++trial) {
        Tree tree;
        append_full(random, nodes, 5, tree);
        calls += tree.front().primitive == Primitive::hyperbolic_tangent ? 1 : 0;  // only the second begins so
      }
      EXPECT_NEAR(calls, kDraws * weight / (8.0 + 2.0 * weight), 300);
    }
  }
}

TEST(Calls, ThatAreTooDeepGiveWayToFunctions) {
  RandomStream random{394};
  const NodeSet nodes = node_set(with_functions(), 1);
  for (int trial = 0; trial < 500; ++trial) {
    Tree tree;
    append_full(random, nodes, 2, tree);  // the bodies have a depth of 3
    EXPECT_TRUE(folded(tree, two_functions()).calls.empty());
    EXPECT_EQ(depth(tree), 2);
  }
}

TEST(Calls, WithoutFunctionsChangeNoDraw) {
  GpParameters weighed;
  weighed.shared_function_weight = 7.0;
  RandomStream one{395}, other{395};
  EXPECT_EQ(ramped_half_and_half(one, GpParameters{}, 1), ramped_half_and_half(other, weighed, 1));
}

TEST(FirstPopulation, HoldsTheNeutralModelOnce) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random{34, seed};
    GpParameters parameters;
    // At depth 1 the neutral model is easily drawn by chance.
    parameters.min_tree_depth = parameters.initial_max_tree_depth1 = parameters.initial_max_tree_depth2 = 1;
    parameters.functions = {Primitive::subtract};
    const auto trees = ramped_half_and_half(random, parameters, 1);
    EXPECT_EQ(trees.size(), 300u);
    EXPECT_EQ(std::count(trees.begin(), trees.end(), neutral_tree()), 1);
  }
}

TEST(FirstPopulation, HoldsNoTreeTwice) {
  RandomStream random{35};
  const auto trees = ramped_half_and_half(random, GpParameters{}, 1);
  for (std::size_t i = 0; i < trees.size(); ++i)
    EXPECT_EQ(std::count(trees.begin(), trees.end(), trees[i]), 1) << "tree " << i;
}

TEST(FirstPopulation, RampsTheDepthsHalfFullHalfGrown) {
  RandomStream random{36};
  const GpParameters parameters;
  const auto trees = ramped_half_and_half(random, parameters, 1);
  std::map<int, int> full_depths;
  for (std::size_t i = 1; i < trees.size(); ++i) {
    ASSERT_TRUE(is_valid(trees[i], 1));
    ASSERT_GE(depth(trees[i]), parameters.min_tree_depth);
    ASSERT_LE(depth(trees[i]), parameters.initial_max_tree_depth2);
    if (i % 2 == 1) ++full_depths[depth(trees[i])];
  }
  EXPECT_EQ(full_depths, (std::map<int, int>{{3, 50}, {4, 50}, {5, 50}}));
}

TEST(FirstPopulation, EndsWhereTooFewTreesDiffer) {
  RandomStream random{37};
  GpParameters parameters;
  parameters.min_tree_depth = parameters.initial_max_tree_depth1 = parameters.initial_max_tree_depth2 = 1;
  parameters.functions = {Primitive::sine};
  parameters.constants_lower = 1.0;
  parameters.constants_upper = std::nextafter(1.0, 2.0);
  EXPECT_EQ(ramped_half_and_half(random, parameters, 1).size(), 300u);
}

TEST(FirstPopulation, ReachesMinimaThatGrowHardlyEverDoes) {
  RandomStream random{38};
  GpParameters parameters;
  parameters.population_size = 20;
  parameters.min_tree_depth = parameters.initial_max_tree_depth1 = 15;
  parameters.initial_max_tree_depth2 = parameters.max_tree_depth = 15;
  parameters.functions = {Primitive::sine};
  const auto trees = ramped_half_and_half(random, parameters, 1);
  for (std::size_t i = 1; i < trees.size(); ++i) EXPECT_EQ(depth(trees[i]), 15);
}

TEST(TreeIndex, GivesTheFirstOfEqualTrees) {
  RandomStream random{51};
  const NodeSet nodes{{Primitive::add, Primitive::sine}, 2, 0.0, 1.0};
  std::vector<Tree> trees(2000);
  for (Tree& tree : trees) append_grown(random, nodes, 2, tree);
  TreeIndex index(trees.size());
  int repeated = 0;
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const auto first = std::find(trees.begin(), trees.end(), trees[i]);
      ASSERT_EQ(index.enter(trees[i], i), static_cast<std::size_t>(first - trees.begin()));
      repeated += first - trees.begin() < static_cast<std::ptrdiff_t>(i);
    }
    index.clear(trees.size());
  }
  EXPECT_GT(repeated, 500);
}

}  // namespace
}  // namespace demecal
