#include "expression/tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "errors/check.hpp"

namespace demecal::inline expression {

Tree constant_tree(double value) {
  return {Node{Primitive::constant, 0, value}};
}

Tree variable_tree(std::uint8_t variable) {
  return {Node{Primitive::variable, variable, 0.0}};
}

Tree neutral_tree() {
  return apply(Primitive::subtract, variable_tree(0), variable_tree(0));
}

Tree apply(Primitive function, Tree argument) {
  DEMECAL_CHECK(arity(function) == 1, "function=" << traits(function).symbol);
  argument.insert(argument.begin(), Node{function, 0, 0.0});
  return argument;
}

Tree apply(Primitive function, const Tree& left, const Tree& right) {
  DEMECAL_CHECK(arity(function) == 2, "function=" << traits(function).symbol);
  Tree tree;
  tree.reserve(1 + left.size() + right.size());
  tree.push_back(Node{function, 0, 0.0});
  tree.insert(tree.end(), left.begin(), left.end());
  tree.insert(tree.end(), right.begin(), right.end());
  return tree;
}

Tree apply_folded(Primitive function, Tree argument) {
  if (is_constant(argument)) {
    const double value = value_of(function, argument.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  return apply(function, std::move(argument));
}

Tree apply_folded(Primitive function, const Tree& left, const Tree& right) {
  if (is_constant(left) && is_constant(right)) {
    const double value = value_of(function, left.front().value, right.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  return apply(function, left, right);
}

std::size_t subtree_end(std::span<const Node> tree, std::size_t begin) {
  std::size_t end = begin;
  for (int missing = 1; missing > 0; ++end) missing += arity(tree[end].primitive) - 1;
  return end;
}

int depth(std::span<const Node> tree) {
  return fold<int>(
      tree, [](const Node&) { return 0; }, [](Primitive, int argument) { return argument + 1; },
      [](Primitive, int left, int right) { return std::max(left, right) + 1; });
}

bool is_valid(std::span<const Node> tree, int variables) {
  std::size_t missing = 1;
  for (const Node& node : tree) {
    if (missing == 0 || static_cast<std::size_t>(node.primitive) >= kPrimitives.size()) return false;
    if (node.primitive == Primitive::constant && !std::isfinite(node.value)) return false;
    if (node.primitive == Primitive::variable && node.variable >= variables) return false;
    missing += static_cast<std::size_t>(arity(node.primitive));
    --missing;
  }
  return missing == 0;
}

bool contains(std::span<const Node> tree, Primitive primitive) {
  return std::any_of(tree.begin(), tree.end(), [primitive](const Node& node) { return node.primitive == primitive; });
}

namespace {

bool node_precedes(const Node& a, const Node& b) {
  const auto rank = [](const Node& node) {
    return std::tuple(node.primitive, node.variable, std::bit_cast<std::uint64_t>(node.value));
  };
  return rank(a) < rank(b);
}

}  // namespace

bool is_commutative(Primitive function) {
  return function == Primitive::add || function == Primitive::multiply || function == Primitive::minimum ||
         function == Primitive::maximum;
}

bool precedes(std::span<const Node> a, std::span<const Node> b) {
  if (a.size() != b.size()) return a.size() < b.size();
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), node_precedes);
}

Tree apply_in_order(Primitive function, const Tree& a, const Tree& b) {
  if (!is_commutative(function)) return apply(function, a, b);
  const bool larger_first = function == Primitive::add;
  const bool swaps = larger_first ? precedes(a, b) : precedes(b, a);
  return swaps ? apply(function, b, a) : apply(function, a, b);
}

Tree with_negatives_added(std::span<const Node> tree) {
  Tree sums(tree.begin(), tree.end());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].primitive != Primitive::subtract) continue;
    Node& subtracted = sums[subtree_end(sums, i + 1)];
    if (subtracted.primitive != Primitive::constant) continue;
    sums[i].primitive = Primitive::add;
    subtracted.value = -subtracted.value;
  }
  return sums;
}

Tree in_order(std::span<const Node> tree) {
  return fold<Tree>(
      with_negatives_added(tree), [](const Node& node) { return Tree{node}; },
      [](Primitive function, Tree argument) { return apply(function, std::move(argument)); }, apply_in_order);
}

}  // namespace demecal::inline expression
