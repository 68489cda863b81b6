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

/// What becomes of a - c with a constant c.
enum class Subtracted { stays, adds_negative };

/// The formula with all its arguments in that order, and a + -c in place of a - c unless it stays: the same values, to
/// the bit but for the sign of zero.
Tree in_order(std::span<const Node> tree, Subtracted constant = Subtracted::adds_negative);

}  // namespace demecal
