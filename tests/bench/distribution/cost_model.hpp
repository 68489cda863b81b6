// What an epoch costs beside its work, as a straight line over the number of islands.
#pragma once

#include <vector>

namespace demecal::bench {

struct EpochTime {
  double islands = 0.0;
  double beyond_ideal_s = 0.0;  ///< time per epoch less the work's
};

/// beyond_ideal_s = fixed_s + per_island_s * islands, by least squares; needs two numbers of islands.
struct CostModel {
  double fixed_s = 0.0;
  double per_island_s = 0.0;

  double at(double islands) const { return fixed_s + per_island_s * islands; }
};
CostModel fit(const std::vector<EpochTime>& times);

}  // namespace demecal::bench
