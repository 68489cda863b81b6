// The elementary transforms of a structure that was found, as reports name them.
#pragma once

#include <string>
#include <vector>

#include "structure/structure_fit.hpp"

namespace demecal {

struct FoundTransform {
  int link = 0;  ///< it stands after this one, from 0
  Gene gene;
  double value = 0.0;           ///< rad or m
  double standard_error = 0.0;  ///< rad or m

  /// "after link 2 Ry_deg", "after link 3 Tx_mm".
  std::string name() const;
  /// rad or m to the unit of the name.
  double at_border(double amount) const;
};

/// In the order in which they stand along the arm.
std::vector<FoundTransform> found_transforms(const StructureProblem& problem, const StructureFit& fit);

}  // namespace demecal
