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

}  // namespace demecal
