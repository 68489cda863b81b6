#include "evolution/island_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {

GpParameters parameters_of(const GpParameters& parameters, const Archipelago& archipelago, std::uint32_t deme) {
  if (archipelago.spread == 0.0 || archipelago.demes_per_joint < 2) return parameters;
  const double place = 2.0 * deme / (archipelago.demes_per_joint - 1.0) - 1.0;  // -1 to 1
  const double more = 1.0 + archipelago.spread * place, less = 1.0 - archipelago.spread * place;
  GpParameters own = parameters;
  own.mutation_rate = std::min(1.0, less * parameters.mutation_rate);
  own.shrink_mutation_rate = std::min(1.0, more * parameters.shrink_mutation_rate);
  own.tournament_size =
      std::clamp(static_cast<int>(std::lround(more * parameters.tournament_size)), 1, parameters.population_size);
  return own;
}

}  // namespace demecal
