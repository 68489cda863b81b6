#include "evolution/individual.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {

void ParetoFront::offer(const Individual& individual) {
  if (!std::isfinite(individual.fitness)) return;
  const auto shorter = [](const Individual& member, std::size_t length) { return member.tree.size() < length; };
  const auto place = std::lower_bound(members_.begin(), members_.end(), individual.tree.size(), shorter);
  if (place != members_.begin() && (place - 1)->fitness <= individual.fitness) return;
  if (place != members_.end() && place->tree.size() == individual.tree.size() && place->fitness <= individual.fitness)
    return;
  const auto better = [&](const Individual& member) { return member.fitness < individual.fitness; };
  const auto undominated = std::find_if(place, members_.end(), better);
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
