#include "explanations/explanation_search.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "evolution/archipelago.hpp"
#include "pieces/pieces.hpp"

namespace demecal::inline explanations {

SetSearch set_search(const std::vector<std::size_t>& known, const ExplanationSearch& search, RandomStream random) {
  constexpr std::size_t kNames = std::size_t{1} << 53;
  return {.known = known, .search = search, .stream = random.index(kNames)};
}

std::vector<EffectSet> front_of(const ExplanationProblem& problem, const std::vector<Population>& elites) {
  std::map<std::size_t, EffectSet> front;
  for (const Population& elite : elites) {
    for (const Individual& member : elite) {
      const FittedSet set = fitted_set(problem, member);
      EffectSet found{set.effects(), set.causes().size(), set.description_nats()};
      std::ranges::sort(found.effects);
      const auto [known, fresh] = front.emplace(found.causes, found);
      if (!fresh && found.description_nats < known->second.description_nats) known->second = std::move(found);
    }
  }
  std::vector<EffectSet> sets;
  for (auto& [causes, set] : front) sets.push_back(std::move(set));
  return sets;
}

std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const SetSearch& search) {
  SetIsland settled(problem, search, {});
  settled.settle();
  std::vector<SetIsland> islands;
  for (std::uint32_t deme = 0; deme < kSetIslands; ++deme) islands.push_back(settled.settled_at({0, deme}));
  std::vector<Population> elites(islands.size());
  for (std::uint32_t epoch = 0; epoch < kSetEpochs; ++epoch) {
    in_pieces(islands.size(),
              [&](std::size_t i) { islands[i].run_epoch(elites[(i + islands.size() - 1) % islands.size()]); });
    for (std::size_t i = 0; i < islands.size(); ++i) elites[i] = islands[i].emigrants();
  }
  return front_of(problem, elites);
}

std::vector<EffectSet> prunings(const ExplanationProblem& problem, const std::vector<std::size_t>& known) {
  SetIsland settled(problem, {.known = known, .search = {.variations = 0}}, {});
  settled.settle();
  return front_of(problem, {settled.emigrants()});
}

}  // namespace demecal::inline explanations
