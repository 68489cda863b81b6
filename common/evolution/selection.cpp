#include "evolution/selection.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace demecal {

std::size_t tournament(RandomStream& random, std::span<const double> fitness, int size) {
  std::size_t winner = random.index(fitness.size());
  for (int i = 1; i < size; ++i) {
    const std::size_t rival = random.index(fitness.size());
    if (fitness[rival] < fitness[winner]) winner = rival;
  }
  return winner;
}

std::size_t fittest(std::span<const double> fitness) {
  return static_cast<std::size_t>(std::min_element(fitness.begin(), fitness.end()) - fitness.begin());
}

std::vector<std::size_t> ranking(std::span<const double> fitness) {
  std::vector<std::size_t> indices(fitness.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::sort(indices.begin(), indices.end(),
            [&](std::size_t a, std::size_t b) { return std::tie(fitness[a], a) < std::tie(fitness[b], b); });
  return indices;
}

}  // namespace demecal
