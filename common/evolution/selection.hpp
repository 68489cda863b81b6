// Who breeds: tournament selection (thesis 3.2.2).
#pragma once

#include <cstddef>

#include "evolution/individual.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// Index of the fittest of `size` individuals drawn uniformly with replacement; of equals the one drawn first, so that
/// no place in the population is favoured.
std::size_t tournament(RandomStream& random, const Population& population, int size);

/// Index of the fittest; of equals the first. The population must not be empty.
std::size_t fittest(const Population& population);

/// All indices from the fittest to the worst; equals by index.
std::vector<std::size_t> ranking(const Population& population);

}  // namespace demecal
