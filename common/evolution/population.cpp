#include "evolution/population.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace demecal::inline evolution {

Population::const_iterator ParetoFront::first_as_long(std::size_t length) const {
  const auto shorter = [](const Individual& member, std::size_t most) { return member.tree.size() < most; };
  return std::lower_bound(members_.begin(), members_.end(), length, shorter);
}

bool ParetoFront::would_enter(std::size_t length, double fitness) const {
  if (!std::isfinite(fitness)) return false;
  const auto place = first_as_long(length);
  if (place != members_.begin() && (place - 1)->fitness <= fitness) return false;
  return place == members_.end() || place->tree.size() != length || place->fitness > fitness;
}

void ParetoFront::offer(const Individual& individual) {
  if (!would_enter(individual.tree.size(), individual.fitness)) return;
  const auto place = first_as_long(individual.tree.size());
  const auto better = [&](const Individual& member) { return member.fitness < individual.fitness; };
  const auto undominated = std::find_if(place, members_.cend(), better);
  members_.insert(members_.erase(place, undominated), individual);
  if (members_.size() > kMostMembers) drop_least_gain();
}

void ParetoFront::drop_least_gain() {
  const auto gain = [&](std::size_t i) { return members_[i - 1].fitness - members_[i].fitness; };
  std::size_t least = 1;
  for (std::size_t i = 2; i + 1 < members_.size(); ++i)
    if (gain(i) <= gain(least)) least = i;
  members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(least));
}

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

}  // namespace demecal::inline evolution
