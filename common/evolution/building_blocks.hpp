// Which expressions good individuals share across joints (thesis 7.1 iii).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolution/individual.hpp"
#include "expression/text.hpp"

namespace demecal {

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

}  // namespace demecal
