// The catalogue's laws as expressions of the joints.
#pragma once

#include "formulas/symbolic_state.hpp"

namespace demecal {

/// What a unit of one coefficient does, as UnitMotion.
struct SymbolicUnit {
  int coefficient;
  int place;
  int axis;
  Expression size;
};

/// What a unit of each coefficient of the effect does at the state; what comes to nothing there is left out. `name`
/// stands for the effect's formula where it has one. Kinds that are not known here (none of the catalogue) give
/// nothing.
std::vector<SymbolicUnit> symbolic_units(const Effect& effect, const SymbolicState& state, const std::string& name);

/// The same with the effect held, and faded, beyond the ranges it was measured in, as append_unit_motions() does it.
std::vector<SymbolicUnit> held_units(const Effect& effect, const SymbolicState& state, const std::string& name);

}  // namespace demecal
