// A population whose formulas share their subtrees in one store.
#pragma once

#include <cstddef>
#include <vector>

#include "expression/node_store.hpp"

namespace demecal {

/// fitness[i] is that of models[i]: of roots[i] itself or, where fitted constants are not inherited, of what roots[i]
/// was fitted to; models[i] is 0 where that is no longer known.
struct SharedPopulation {
  std::vector<NodeId> roots;
  std::vector<double> fitness;
  std::vector<NodeId> models;
};

}  // namespace demecal
