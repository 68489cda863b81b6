// Formulas that differ only in the order of arguments which have none: one of them stands for all.
#pragma once

#include <span>

#include "expression/tree.hpp"

namespace demecal {

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

}  // namespace demecal
