#include "evolution/island.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "errors/check.hpp"
#include "evolution/selection.hpp"
#include "evolution/tree_generation.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

bool stands_in(const Population& population, const Tree& tree) {
  return std::any_of(population.begin(), population.end(), [&](const Individual& one) { return one.tree == tree; });
}

void offer_all(ParetoFront& front, const Population& population) {
  for (const Individual& individual : population) front.offer(individual);
}

}  // namespace

Island::Island(const GpParameters& parameters, const Archipelago& archipelago, const TrainingTable& table,
               IslandKey key, std::uint64_t seed)
    : parameters_(parameters),
      archipelago_(archipelago),
      fitness_(table),
      variables_(static_cast<int>(table.variables.size())),
      breeder_(parameters, variables_),
      key_(key),
      seed_(seed) {
  const auto fault = find_fault(parameters);
  DEMECAL_CHECK(!fault, fault->key << " = " << fault->value << " " << fault->rule);
  DEMECAL_CHECK(archipelago.migration_interval > 0, "migration_interval = 0");
}

std::uint32_t Island::epochs_total() const {
  const auto generations = static_cast<std::uint32_t>(parameters_.number_generations);
  return 1 + generations / archipelago_.migration_interval + (generations % archipelago_.migration_interval != 0);
}

bool Island::finished() const {
  return state_.epoch >= epochs_total();
}

std::uint32_t Island::generations_of_epoch() const {
  if (state_.epoch == 0) return 0;
  return std::min(archipelago_.migration_interval,
                  static_cast<std::uint32_t>(parameters_.number_generations) - state_.generation);
}

void Island::run_epoch(const Population& immigrants, const std::function<void()>& after_generation) {
  DEMECAL_CHECK(!finished(), "epoch=" << state_.epoch << " of " << epochs_total());
  RandomStream random{seed_, key_.joint, key_.deme, state_.epoch};
  if (state_.epoch == 0) found_population(random);
  take_in(immigrants);
  ParetoFront front(std::move(state_.front));
  offer_all(front, state_.population);
  const std::uint32_t generations = generations_of_epoch();
  for (std::uint32_t i = 0; i < generations; ++i) {
    state_.evaluations += breeder_.breed(random, state_.population, fitness_);
    offer_all(front, state_.population);
    if (after_generation) after_generation();
  }
  state_.front = std::move(front).release();
  state_.generation += generations;
  ++state_.epoch;
}

void Island::found_population(RandomStream& random) {
  state_.population.clear();
  for (Tree& tree : ramped_half_and_half(random, parameters_, variables_)) {
    const double fitness = fitness_(tree);
    state_.population.push_back({std::move(tree), fitness});
  }
  state_.evaluations += state_.population.size();
}

bool Island::fits(const Tree& tree) const {
  return is_valid(tree, variables_) && depth(tree) <= parameters_.max_tree_depth;
}

void Island::take_in(const Population& immigrants) {
  Population& residents = state_.population;
  const std::vector<std::size_t> ranked = ranking(residents);
  std::size_t taken = 0;
  for (const Individual& immigrant : immigrants) {
    if (taken + 1 >= residents.size()) break;
    if (!fits(immigrant.tree) || stands_in(residents, immigrant.tree)) continue;
    ++taken;
    residents[ranked[ranked.size() - taken]] = {immigrant.tree, fitness_(immigrant.tree)};
  }
  state_.evaluations += taken;
  state_.migrants_taken += taken;
}

Population Island::emigrants() const {
  Population chosen;
  for (const std::size_t i : ranking(state_.population)) {
    const Individual& individual = state_.population[i];
    if (chosen.size() >= archipelago_.migrants || !std::isfinite(individual.fitness)) break;
    if (!stands_in(chosen, individual.tree)) chosen.push_back(individual);
  }
  return chosen;
}

IslandFigures Island::figures() const {
  if (state_.population.empty()) return {};
  const std::vector<std::size_t> ranked = ranking(state_.population);
  const Individual& best = state_.population[ranked.front()];
  const Individual& median = state_.population[ranked[(ranked.size() - 1) / 2]];
  return {best.fitness, median.fitness, static_cast<std::uint32_t>(best.tree.size())};
}

void Island::restore(IslandState state) {
  DEMECAL_CHECK(state.epoch == 0 || state.population.size() == static_cast<std::size_t>(parameters_.population_size),
                "epoch=" << state.epoch << " population=" << state.population.size());
  state_ = std::move(state);
}

}  // namespace demecal
