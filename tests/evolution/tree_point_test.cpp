// Places in shared formulas against places in prefix order.
#include "evolution/variation.hpp"

#include <gtest/gtest.h>

#include "evolution/tree_generation.hpp"

namespace demecal {
namespace {

TEST(TreePoint, CountsTerminalsAndFunctionsInPrefixOrder) {
  RandomStream random{41};
  const NodeSet nodes = node_set(GpParameters{}, 2);
  NodeStore store;
  for (int trial = 0; trial < 300; ++trial) {
    Tree tree;
    append_grown(random, nodes, 7, tree);
    const NodeId root = store.enter(tree);
    std::uint32_t terminals = 0, functions = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const bool terminal = arity(tree[i].primitive) == 0;
      const TreePoint point =
          terminal ? TreePoint::terminal(store, root, terminals++) : TreePoint::function(store, root, functions++);
      const std::span<const Node> part = std::span(tree).subspan(i, subtree_end(tree, i) - i);
      ASSERT_EQ(store.tree(point.node()), Tree(part.begin(), part.end()));
      int ancestors = 0;
      for (std::size_t above = 0; above < i; ++above) ancestors += subtree_end(tree, above) > i ? 1 : 0;
      ASSERT_EQ(point.level(), ancestors);
    }
    ASSERT_EQ(terminals, store[root].whole.terminals);
    ASSERT_EQ(functions, store[root].whole.functions());
  }
}

TEST(TreePoint, ReplacesASubtreeAndForetellsTheDepth) {
  RandomStream random{42};
  const NodeSet nodes = node_set(GpParameters{}, 1);
  NodeStore store;
  for (int trial = 0; trial < 2000; ++trial) {
    Tree tree, replacement;
    append_grown(random, nodes, 6, tree);
    const int replacement_depth = append_grown(random, nodes, 4, replacement);
    const std::size_t place = random.index(tree.size());
    std::uint32_t before = 0;
    const bool terminal = arity(tree[place].primitive) == 0;
    for (std::size_t i = 0; i < place; ++i) before += (arity(tree[i].primitive) == 0) == terminal ? 1 : 0;
    const NodeId root = store.enter(tree);
    const TreePoint point =
        terminal ? TreePoint::terminal(store, root, before) : TreePoint::function(store, root, before);
    const NodeId whole = point.replaced(store, store.enter(replacement));
    const auto begin = tree.begin() + static_cast<std::ptrdiff_t>(place);
    const auto after = tree.erase(begin, tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, place)));
    tree.insert(after, replacement.begin(), replacement.end());
    ASSERT_EQ(store.tree(whole), tree);
    ASSERT_EQ(point.depth_with(replacement_depth), depth(tree));
  }
}

}  // namespace
}  // namespace demecal
