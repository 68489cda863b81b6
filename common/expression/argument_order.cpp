#include "expression/argument_order.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "expression/fold.hpp"

namespace demecal {
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

Tree in_order(std::span<const Node> tree, Subtracted constant) {
  return fold<Tree>(
      tree, [](const Node& node) { return Tree{node}; },
      [](Primitive function, Tree argument) { return apply(function, std::move(argument)); },
      [constant](Primitive function, const Tree& left, const Tree& right) {
        const bool takes_constant = function == Primitive::subtract && right.front().primitive == Primitive::constant;
        if (takes_constant && constant == Subtracted::adds_negative)
          return apply_in_order(Primitive::add, left, constant_tree(-right.front().value));
        return apply_in_order(function, left, right);
      });
}

}  // namespace demecal
