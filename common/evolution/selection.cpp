#include "evolution/selection.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace demecal {

std::size_t tournament(RandomStream& random, const Population& population, int size) {
  std::size_t winner = random.index(population.size());
  for (int i = 1; i < size; ++i) {
    const std::size_t rival = random.index(population.size());
    if (population[rival].fitness < population[winner].fitness) winner = rival;
  }
  return winner;
}

std::size_t fittest(const Population& population) {
  const auto fitter = [](const Individual& a, const Individual& b) { return a.fitness < b.fitness; };
  const auto best = std::min_element(population.begin(), population.end(), fitter);
  return static_cast<std::size_t>(best - population.begin());
}

std::vector<std::size_t> ranking(const Population& population) {
  std::vector<std::size_t> indices(population.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(population[a].fitness, a) < std::tie(population[b].fitness, b);
  });
  return indices;
}

}  // namespace demecal
