// One walk for all that is computed bottom-up over a formula: value, text, depth, interval, derivative.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// What `leaf(node)`, `unary(function, argument)` and `binary(function, left, right)` make of a valid tree, from its
/// last node to its first. Not recursive, so that no tree is too deep; small trees allocate nothing here.
template <class Value, class Leaf, class Unary, class Binary>
Value fold(std::span<const Node> tree, Leaf leaf, Unary unary, Binary binary) {
  std::array<Value, 32> few{};
  std::vector<Value> many;
  const std::size_t most_leaves = tree.size() / 2 + 1;
  if (most_leaves > few.size()) many.resize(most_leaves);
  Value* const stack = many.empty() ? few.data() : many.data();
  std::size_t height = 0;
  for (std::size_t i = tree.size(); i-- > 0;) {
    const Node& node = tree[i];
    switch (arity(node.primitive)) {
      case 0:
        stack[height++] = leaf(node);
        break;
      case 1:
        stack[height - 1] = unary(node.primitive, std::move(stack[height - 1]));
        break;
      default:
        --height;
        stack[height - 1] = binary(node.primitive, std::move(stack[height]), std::move(stack[height - 1]));
    }
  }
  return std::move(stack[0]);
}

}  // namespace demecal
