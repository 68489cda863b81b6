// A formula as a prefix sequence of nodes: the form in which it is evolved, sent and stored.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "expression/primitive.hpp"

namespace demecal {

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

/// One past the last node of the subtree that begins at `begin` (tree must be valid there).
std::size_t subtree_end(std::span<const Node> tree, std::size_t begin);
/// Arcs from the root to the most remote leaf; a lone terminal has depth 0 (thesis 3.3.1).
int depth(std::span<const Node> tree);
/// Whether `tree` is one complete formula of known primitives, finite constants and variables below `variables`.
bool is_valid(std::span<const Node> tree, int variables);
/// Whether any node is the given primitive.
bool contains(std::span<const Node> tree, Primitive primitive);

}  // namespace demecal
