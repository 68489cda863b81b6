// What good formulas of several joints share: expressions (thesis 7.1 iii), and functions worth sharing (7.1 ii).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolution/population.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"

namespace demecal::inline evolution {

/// What one island ended with: its best of each length.
struct IslandFront {
  std::uint32_t joint = 0;
  Population members;
};

/// A form of expression and who holds it.
struct BuildingBlock {
  Tree form;                    ///< canonical, see block_form()
  std::size_t joints = 0;       ///< different ones
  std::size_t islands = 0;      ///< fronts
  std::size_t individuals = 0;  ///< members of fronts
  double rank_share = 0.0;  ///< of its front that an individual is fitter than: 0 to 1, mean over those that hold it
};

/// The formula but for the values of constants and the order of arguments: without what changes no value (see
/// simplified()), every expression of constants is one unknown constant, variable 0 (the formula's own variables count
/// on from 1), which takes in constants that it is added to or multiplied with; arguments of + * MIN MAX stand in a
/// fixed order, and a - c and a % c are a + c and c * a. The formula must have fewer than 255 variables.
Tree block_form(const Tree& formula);

/// The form as text, its constants "c"; `names` are those of the formula's own variables.
std::string block_text(const Tree& form, const VariableNames& names = theta_only());

/// Which forms are worth a line.
struct BlockLimits {
  std::size_t least_joints = 2;     ///< that hold it
  std::size_t least_functions = 2;  ///< in it: what every formula is made of is no block
};

/// The forms that stand, as a whole or within another, in members of the fronts: by joints, islands, individuals and
/// nodes, more first. Left out is a form that every individual which has it has within one and the same larger form.
std::vector<BuildingBlock> building_blocks(std::span<const IslandFront> fronts, const BlockLimits& limits = {});

/// At most `most` functions that shorten good formulas, given by joint: one after the other that which, with those
/// before it, leaves the fewest nodes and calls of all formulas and definitions together, as long as each lowers that
/// number and formulas of two joints or more call it. What counts of a formula is its form (see block_form()): every
/// expression of constants is a number, and where a number stands in the structure is a coefficient, of which there is
/// one at least. What else differs is an argument, of which there are two at most; places that take the same
/// argument may be one. Structures have from three to kLargestStructure functions. A function of the formulas and their
/// order.
std::vector<SharedFunction> find_shared_functions(std::span<const std::vector<Tree>> formulas, std::size_t most);

inline constexpr std::size_t kLargestStructure = 5;

}  // namespace demecal::inline evolution
