// Formulas that share subtrees: equal ones have equal numbers, and nothing that is needed is collected.
#include "expression/node_store.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "expression/evaluate.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

std::set<std::vector<std::uint64_t>> different_subtrees(const std::vector<Tree>& trees) {
  std::set<std::vector<std::uint64_t>> different;
  for (const Tree& tree : trees) {
    for (std::size_t i = 0; i < tree.size(); ++i) {
      std::vector<std::uint64_t> bits;
      for (std::size_t k = i; k < subtree_end(tree, i); ++k) {
        bits.push_back(static_cast<std::uint64_t>(tree[k].primitive) << 8 | tree[k].variable);
        bits.push_back(std::bit_cast<std::uint64_t>(tree[k].value));
      }
      different.insert(bits);
    }
  }
  return different;
}

std::vector<Tree> random_trees(RandomStream& random, int count) {
  std::vector<Tree> trees;
  for (int i = 0; i < count; ++i) trees.push_back(random_tree(random, 7, 3));
  return trees;
}

TEST(NodeStore, GivesBackEveryTreeThatWasEntered) {
  RandomStream random{7, 1};
  NodeStore store;
  for (const Tree& tree : random_trees(random, 500)) ASSERT_EQ(store.tree(store.enter(tree)), tree);
}

TEST(NodeStore, HoldsEveryDifferentSubtreeOnce) {
  RandomStream random{7, 2};
  const std::vector<Tree> trees = random_trees(random, 300);
  NodeStore store;
  std::map<NodeId, Tree> by_number;
  for (const Tree& tree : trees) by_number[store.enter(tree)] = tree;
  EXPECT_EQ(store.size(), different_subtrees(trees).size());
  for (const Tree& tree : trees) EXPECT_EQ(by_number[store.enter(tree)], tree);
  EXPECT_EQ(store.size(), different_subtrees(trees).size());
}

TEST(NodeStore, TellsZeroFromMinusZeroAndConstantsFromVariables) {
  NodeStore store;
  const std::set<NodeId> numbers{store.enter(constant_tree(0.0)), store.enter(constant_tree(-0.0)),
                                 store.enter(variable_tree(0)), store.enter(variable_tree(1)),
                                 store.enter(constant_tree(1.0))};
  EXPECT_EQ(numbers.size(), 5u);
}

TEST(NodeStore, KnowsTheExtentOfEveryFormula) {
  RandomStream random{7, 3};
  NodeStore store;
  for (const Tree& tree : random_trees(random, 300)) {
    const SharedNode& node = store[store.enter(tree)];
    std::uint32_t functions = 0;
    for (const Node& one : tree) functions += arity(one.primitive) > 0 ? 1 : 0;
    ASSERT_EQ(node.whole.nodes, tree.size());
    ASSERT_EQ(node.whole.functions(), functions);
    ASSERT_EQ(node.whole.depth, depth(tree));
    ASSERT_EQ(node.is_constant, !contains(tree, Primitive::variable));
    if (node.is_constant) {
      const double value = evaluate(tree, {});
      ASSERT_EQ(std::bit_cast<std::uint64_t>(node.value), std::bit_cast<std::uint64_t>(value));
    }
  }
}

TEST(NodeStore, CollectsExactlyWhatNoRootNeeds) {
  RandomStream random{7, 4};
  NodeStore store;
  std::vector<Tree> kept;
  for (int round = 0; round < 30; ++round) {
    std::vector<Tree> trees = random_trees(random, 60);
    trees.insert(trees.end(), kept.begin(), kept.end());
    std::vector<NodeId> roots;
    for (const Tree& tree : trees) roots.push_back(store.enter(tree));
    const std::size_t all = store.size();
    ASSERT_EQ(all, different_subtrees(trees).size());
    const std::size_t end = store.end();
    kept.assign(trees.begin() + 10, trees.begin() + 40);
    const std::vector<NodeId> kept_roots(roots.begin() + 10, roots.begin() + 40);
    const std::set<NodeId> dropped = [&] {
      const std::span<const NodeId> numbers = store.collect(kept_roots);
      return std::set<NodeId>(numbers.begin(), numbers.end());
    }();
    ASSERT_EQ(store.size(), different_subtrees(kept).size());
    ASSERT_EQ(dropped.size(), all - store.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      ASSERT_EQ(store.enter(kept[i]), kept_roots[i]);
      ASSERT_EQ(store.tree(kept_roots[i]), kept[i]);
      ASSERT_FALSE(dropped.contains(kept_roots[i]));
    }
    ASSERT_EQ(store.end(), end);
  }
}

}  // namespace
}  // namespace demecal
