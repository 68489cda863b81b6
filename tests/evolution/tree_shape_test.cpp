// The shape of trees, against the plain functions of the expression room.
#include "evolution/tree_shape.hpp"

#include <gtest/gtest.h>

#include "evolution/tree_generation.hpp"

namespace demecal {
namespace {

TEST(TreeShape, AgreesWithTheTree) {
  RandomStream random{41};
  const NodeSet nodes = node_set(GpParameters{}, 1);
  TreeShape shape;
  for (int trial = 0; trial < 500; ++trial) {
    Tree tree;
    append_grown(random, nodes, 7, tree);
    shape.measure(tree);
    ASSERT_EQ(shape.terminals().size() + shape.functions().size(), tree.size());
    for (const std::size_t i : shape.terminals()) ASSERT_EQ(arity(tree[i].primitive), 0);
    for (const std::size_t i : shape.functions()) ASSERT_GT(arity(tree[i].primitive), 0);
    for (std::size_t i = 0; i < tree.size(); ++i) {
      ASSERT_EQ(shape.end(i), subtree_end(tree, i));
      ASSERT_EQ(shape.subtree_depth(i), depth(std::span(tree).subspan(i, shape.end(i) - i)));
      int ancestors = 0;
      for (std::size_t above = 0; above < i; ++above) ancestors += subtree_end(tree, above) > i;
      ASSERT_EQ(shape.level(i), ancestors);
    }
  }
}

TEST(TreeShape, ForetellsTheDepthAfterAReplacement) {
  RandomStream random{42};
  const NodeSet nodes = node_set(GpParameters{}, 1);
  TreeShape shape;
  for (int trial = 0; trial < 3000; ++trial) {
    Tree tree, replacement;
    append_grown(random, nodes, 6, tree);
    const int replacement_depth = append_grown(random, nodes, 4, replacement);
    shape.measure(tree);
    const std::size_t point = random.index(tree.size());
    const int foretold = shape.depth_with(point, replacement_depth);
    const auto begin = tree.begin() + static_cast<std::ptrdiff_t>(point);
    const auto after = tree.erase(begin, tree.begin() + static_cast<std::ptrdiff_t>(shape.end(point)));
    tree.insert(after, replacement.begin(), replacement.end());
    ASSERT_EQ(foretold, depth(tree));
  }
}

}  // namespace
}  // namespace demecal
