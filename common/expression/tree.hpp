// A formula as a prefix sequence of nodes, the form in which it is evolved, sent and stored; its walk and its order.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "primitives/primitive.hpp"

namespace demecal::inline expression {

struct Node {
  Primitive primitive = Primitive::constant;
  std::uint8_t variable = 0;  ///< index of the variable where primitive is variable, else 0
  double value = 0.0;         ///< the constant where primitive is constant, else 0

  /// To the bit: 0 and -0 differ.
  bool operator==(const Node& other) const {
    return primitive == other.primitive && variable == other.variable &&
           std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(other.value);
  }
};

/// Nodes in prefix order: a function stands before its arguments, left to right. A valid tree has at least one node and
/// exactly the arguments its functions take; trees compare equal when they are the same formula to the bit.
using Tree = std::vector<Node>;

Tree constant_tree(double value);
Tree variable_tree(std::uint8_t variable);
/// (theta - theta): the model that corrects nothing (thesis 4.4.1, note 35).
Tree neutral_tree();
/// A function applied to whole trees. The first takes its argument by value so that no call prefers std::apply.
Tree apply(Primitive function, Tree argument);
Tree apply(Primitive function, const Tree& left, const Tree& right);
/// The same, as one constant where the arguments are constants and the value is finite.
Tree apply_folded(Primitive function, Tree argument);
Tree apply_folded(Primitive function, const Tree& left, const Tree& right);

/// One past the last node of the subtree that begins at `begin` (tree must be valid there).
std::size_t subtree_end(std::span<const Node> tree, std::size_t begin);
/// Arcs from the root to the most remote leaf; a lone terminal has depth 0 (thesis 3.3.1).
int depth(std::span<const Node> tree);
/// Whether `tree` is one complete formula of known primitives, finite constants and variables below `variables`.
bool is_valid(std::span<const Node> tree, int variables);
/// Whether it is one constant; of that value.
inline bool is_constant(std::span<const Node> tree) {
  return tree.front().primitive == Primitive::constant;
}
inline bool is_constant(std::span<const Node> tree, double value) {
  return is_constant(tree) && tree.front().value == value;
}
/// Whether any node is the given primitive.
bool contains(std::span<const Node> tree, Primitive primitive);

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

/// Whether the order of a function's arguments changes no value, but for the sign of zero: + * MIN MAX.
bool is_commutative(Primitive function);

/// A total order of formulas: shorter ones first, then node by node.
bool precedes(std::span<const Node> a, std::span<const Node> b);

/// precedes(), as a function object for sets and maps of formulas.
struct Precedes {
  bool operator()(const Tree& a, const Tree& b) const { return precedes(a, b); }
};

/// The function of two arguments, of which the longer stands first in sums and last in everything else that commutes.
Tree apply_in_order(Primitive function, const Tree& a, const Tree& b);

/// The formula with a + -c in place of a - c for every constant c: the same values, to the bit but for the sign of
/// zero.
Tree with_negatives_added(std::span<const Node> tree);

/// That formula with all its arguments in order; also of the same values.
Tree in_order(std::span<const Node> tree);

}  // namespace demecal::inline expression
