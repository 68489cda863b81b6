// Who breeds: tournament selection (thesis 3.2.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "random/random_stream.hpp"

namespace demecal {

/// Index of the fittest of `size` individuals drawn uniformly with replacement from a population of the given fitness
/// values; of equals the one drawn first, so that no place in the population is favoured.
std::size_t tournament(RandomStream& random, std::span<const double> fitness, int size);

/// Index of the fittest; of equals the first. The population must not be empty.
std::size_t fittest(std::span<const double> fitness);

/// All indices from the fittest to the worst; equals by index.
std::vector<std::size_t> ranking(std::span<const double> fitness);

}  // namespace demecal
