// Equal trees are found, others are not.
#include "evolution/tree_index.hpp"

#include <gtest/gtest.h>

#include "evolution/tree_generation.hpp"

namespace demecal {
namespace {

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
