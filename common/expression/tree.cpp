#include "expression/tree.hpp"

#include <algorithm>
#include <cmath>

#include "errors/check.hpp"
#include "expression/fold.hpp"

namespace demecal {

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

}  // namespace demecal
