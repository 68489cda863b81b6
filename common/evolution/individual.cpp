#include "evolution/individual.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {

Population::const_iterator ParetoFront::first_as_long(std::size_t length) const {
  const auto shorter = [](const Individual& member, std::size_t most) { return member.tree.size() < most; };
  return std::lower_bound(members_.begin(), members_.end(), length, shorter);
}

bool ParetoFront::wants(std::size_t length, double fitness) const {
  if (!std::isfinite(fitness)) return false;
  const auto place = first_as_long(length);
  if (place != members_.begin() && (place - 1)->fitness <= fitness) return false;
  return place == members_.end() || place->tree.size() != length || place->fitness > fitness;
}

void ParetoFront::offer(const Individual& individual) {
  if (!wants(individual.tree.size(), individual.fitness)) return;
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

}  // namespace demecal
