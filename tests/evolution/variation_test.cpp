// Crossover and mutation keep to the depth limits and to what their names say.
#include "evolution/variation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fitness/lessons.hpp"
#include "prefix_variation.hpp"

namespace demecal {
namespace {

/// Variation of whole trees by way of a store.
class TreeVariation {
 public:
  TreeVariation(const GpParameters& parameters, int variables) : variation_(parameters, variables) {}

  bool cross(RandomStream& random, const Tree& mother, const Tree& father, Tree& daughter, Tree& son) {
    NodeId one = store_.enter(daughter), other = store_.enter(son);
    const bool crossed = variation_.cross(random, store_, store_.enter(mother), store_.enter(father), one, other);
    daughter = store_.tree(one);
    son = store_.tree(other);
    return crossed;
  }
  bool mutate(RandomStream& random, Tree& tree) {
    NodeId formula = store_.enter(tree);
    const bool mutated = variation_.mutate(random, store_, formula);
    tree = store_.tree(formula);
    return mutated;
  }

 private:
  NodeStore store_;
  Variation variation_;
};

Tree tree_within(RandomStream& random, const NodeSet& nodes, int least, int most) {
  Tree tree;
  do {
    tree.clear();
  } while (append_grown(random, nodes, most, tree) < least);
  return tree;
}

std::vector<Node> sorted_nodes(const Tree& a, const Tree& b) {
  std::vector<Node> nodes(a);
  nodes.insert(nodes.end(), b.begin(), b.end());
  std::sort(nodes.begin(), nodes.end(), [](const Node& x, const Node& y) {
    return std::tie(x.primitive, x.variable, x.value) < std::tie(y.primitive, y.variable, y.value);
  });
  return nodes;
}

/// The nodes before the first and after the last difference are common; what is left of either is what was replaced.
struct Difference {
  std::size_t before = 0, after = 0;
};
Difference difference(const Tree& a, const Tree& b) {
  const std::size_t shorter = std::min(a.size(), b.size());
  Difference common;
  while (common.before < shorter && a[common.before] == b[common.before]) ++common.before;
  while (common.after < shorter - common.before && a[a.size() - 1 - common.after] == b[b.size() - 1 - common.after])
    ++common.after;
  return common;
}

class OverDepthLimits : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  OverDepthLimits() {
    parameters.min_tree_depth = parameters.initial_max_tree_depth1 = parameters.initial_max_tree_depth2 = least();
    parameters.max_tree_depth = most();
    nodes = node_set(parameters, 2);
  }
  static int least() { return GetParam().first; }
  static int most() { return GetParam().second; }
  void expect_within(const Tree& tree) const {
    ASSERT_TRUE(is_valid(tree, 2));
    ASSERT_GE(depth(tree), least());
    ASSERT_LE(depth(tree), most());
  }

  GpParameters parameters;
  NodeSet nodes;
  RandomStream random{61};
};

TEST_P(OverDepthLimits, CrossoverGivesValidOffspringOfTheParentsNodes) {
  TreeVariation variation(parameters, 2);
  int crossed = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Tree mother = tree_within(random, nodes, least(), most());
    const Tree father = tree_within(random, nodes, least(), most());
    Tree daughter = neutral_tree(), son = neutral_tree();
    if (!variation.cross(random, mother, father, daughter, son)) continue;
    ++crossed;
    expect_within(daughter);
    expect_within(son);
    ASSERT_EQ(sorted_nodes(daughter, son), sorted_nodes(mother, father));
    ASSERT_TRUE(daughter != mother && son != father);
  }
  EXPECT_GT(crossed, 2800);
}

TEST_P(OverDepthLimits, MutationGivesValidOffspring) {
  TreeVariation variation(parameters, 2);
  Tree tree = tree_within(random, nodes, least(), most());
  int mutated = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const Tree parent = tree;
    const bool changed = variation.mutate(random, tree);
    mutated += changed;
    ASSERT_EQ(tree != parent, changed);
    expect_within(tree);
  }
  EXPECT_GT(mutated, 5500);
}

TEST_P(OverDepthLimits, OffspringAreThoseOfTheSamePointsInWholeTrees) {
  for (const int most_nodes : {0, 40}) {
    parameters.max_tree_nodes = most_nodes;
    TreeVariation variation(parameters, 2);
    const PrefixVariation plain(parameters, 2);
    for (std::uint64_t trial = 0; trial < 600; ++trial) {
      const Tree mother = tree_within(random, nodes, least(), most());
      const Tree father = tree_within(random, nodes, least(), most());
      Tree daughter = mother, son = father, plain_daughter = mother, plain_son = father;
      RandomStream draws{67, trial}, same_draws{67, trial};
      const bool crossed = variation.cross(draws, mother, father, daughter, son);
      ASSERT_EQ(crossed, plain.cross(same_draws, mother, father, plain_daughter, plain_son));
      ASSERT_TRUE(daughter == plain_daughter && son == plain_son);
      const bool mutated = variation.mutate(draws, daughter);
      ASSERT_EQ(mutated, plain.mutate(same_draws, plain_daughter));
      ASSERT_TRUE(daughter == plain_daughter);
      ASSERT_EQ(draws.index(1U << 30), same_draws.index(1U << 30));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, OverDepthLimits,
                         testing::Values(std::pair{3, 9}, std::pair{1, 4}, std::pair{2, 3}, std::pair{5, 12}));

TEST(Variation, KeepsToTheLimitOfNodes) {
  GpParameters parameters;
  parameters.max_tree_nodes = 63;
  TreeVariation variation(parameters, 1);
  RandomStream random{68};
  std::vector<Tree> trees;
  for (int i = 0; i < 20; ++i) trees.push_back(tree_within(random, node_set(parameters, 1), 3, 5));
  std::size_t largest = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    Tree &mother = trees[random.index(trees.size())], &father = trees[random.index(trees.size())];
    Tree daughter = mother, son = father;
    variation.cross(random, mother, father, daughter, son);
    variation.mutate(random, daughter);
    for (const Tree* offspring : {&daughter, &son}) {
      ASSERT_LE(offspring->size(), 63u);
      largest = std::max(largest, offspring->size());
    }
    mother = daughter;
    father = son;
  }
  EXPECT_GE(largest, 60u);
}

TEST(Crossover, OfTheNeutralModelGivesNothingTooShallow) {
  const GpParameters parameters;
  TreeVariation variation(parameters, 1);
  RandomStream random{62};
  int crossed = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Tree father = tree_within(random, node_set(parameters, 1), 3, 9);
    Tree daughter = neutral_tree(), son = neutral_tree();
    if (!variation.cross(random, neutral_tree(), father, daughter, son)) continue;
    ++crossed;
    ASSERT_GE(std::min(depth(daughter), depth(son)), 3);
  }
  EXPECT_GT(crossed, 250);
}

TEST(Crossover, OfParentsThatCannotGiveValidOffspringLeavesThemOut) {
  TreeVariation variation(GpParameters{}, 1);
  RandomStream random{63};
  Tree daughter = constant_tree(1.0), son = constant_tree(2.0);
  EXPECT_FALSE(variation.cross(random, neutral_tree(), neutral_tree(), daughter, son));
  EXPECT_EQ(daughter, constant_tree(1.0));
  EXPECT_EQ(son, constant_tree(2.0));
}

TEST(Crossover, SwapsTerminalsAtItsRate) {
  // The constants tell what came from whom; with binary functions alone, one of them came with a terminal.
  const NodeSet hers{{Primitive::add}, 0, 0.0, 1.0}, his{{Primitive::add}, 0, 2.0, 3.0};
  const auto is_his = [](const Node& node) { return node.value >= 2.0; };
  RandomStream random{64};
  for (const double rate : {0.0, 0.2, 1.0}) {
    GpParameters parameters;
    parameters.terminal_crossover_rate = rate;
    TreeVariation variation(parameters, 1);
    constexpr int kTrials = 4000;
    int terminals = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      Tree mother, father, daughter = neutral_tree(), son = neutral_tree();
      append_full(random, hers, 5, mother);
      append_full(random, his, 4, father);
      ASSERT_TRUE(variation.cross(random, mother, father, daughter, son));
      terminals += std::count_if(daughter.begin(), daughter.end(), is_his) == 1;
    }
    EXPECT_NEAR(terminals / static_cast<double>(kTrials), rate, 4.0 * std::sqrt(rate * (1.0 - rate) / kTrials) + 0.01);
  }
}

TEST(ShrinkMutation, NeverDeepensATree) {
  GpParameters parameters;
  parameters.min_tree_depth = parameters.initial_max_tree_depth1 = 1;
  parameters.shrink_mutation_rate = 1.0;
  TreeVariation variation(parameters, 1);
  RandomStream random{65};
  int shallower = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Tree tree = tree_within(random, node_set(parameters, 1), 2, 7);
    const Tree parent = tree;
    ASSERT_TRUE(variation.mutate(random, tree));
    ASSERT_LE(depth(tree), depth(parent));
    ASSERT_NE(tree, parent);
    shallower += depth(tree) < depth(parent);
  }
  EXPECT_GT(shallower, 500);
}

TEST(TerminalMutation, ReplacesOneTerminal) {
  GpParameters parameters;
  parameters.shrink_mutation_rate = 0.0;
  parameters.terminal_mutation_rate = 1.0;
  TreeVariation variation(parameters, 1);
  RandomStream random{66};
  for (int trial = 0; trial < 2000; ++trial) {
    Tree tree = tree_within(random, node_set(parameters, 1), 3, 7);
    const Tree parent = tree;
    ASSERT_TRUE(variation.mutate(random, tree));
    ASSERT_GE(tree.size(), parent.size());
    const Difference common = difference(parent, tree);
    ASSERT_LE(parent.size() - common.before - common.after, 1u);
  }
}

}  // namespace
}  // namespace demecal
