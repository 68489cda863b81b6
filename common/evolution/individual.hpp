// A correction model under evolution, and a population of them.
#pragma once

#include <vector>

#include "expression/tree.hpp"

namespace demecal {

struct Individual {
  Tree tree;
  double fitness = 0.0;  ///< raw fitness, smaller is better; infinite where the tree has no finite value on some row
};
using Population = std::vector<Individual>;

/// The best individual of each length (number of nodes) that no shorter one beats: ascending length, falling fitness.
class ParetoFront {
 public:
  /// Enters the individual where it belongs and drops what it dominates; at equal fitness the earlier one stays. Not
  /// entered where its fitness is not finite.
  void offer(const Individual& individual);
  const Population& members() const { return members_; }

 private:
  Population members_;
};

}  // namespace demecal
