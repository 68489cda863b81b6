// Which functions the formulas of several joints should share: structures that shorten what describes them all
// (thesis 7.1 ii).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "expression/shared_function.hpp"

namespace demecal {

/// At most `most` functions that shorten good formulas, given by joint: one after the other that which, with those
/// before it, leaves the fewest nodes and calls of all formulas and definitions together, as long as each lowers that
/// number and formulas of two joints or more call it. What counts of a formula is its form (see block_form()): every
/// expression of constants is a number, and where a number stands in the structure is a coefficient, of which there is
/// one at least. What else differs is an argument, of which there are two at most; places that take the same
/// argument may be one. Structures have from three to kLargestStructure functions. A function of the formulas and their
/// order.
std::vector<SharedFunction> find_shared_functions(std::span<const std::vector<Tree>> formulas, std::size_t most);

inline constexpr std::size_t kLargestStructure = 5;

}  // namespace demecal
