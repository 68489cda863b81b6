#include "effect_sets/set_island.hpp"
#include "effect_sets/set_training.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/population.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "protocol/faults.hpp"
#include "protocol/messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace demecal::inline protocol {
namespace {

constexpr double kMostSetRows = 6.0 * kMostRows;  ///< a position and an orientation each

/// Places among `count`, none of them twice.
bool are_different(const std::vector<std::uint32_t>& places, std::size_t count) {
  const std::set<std::uint32_t> different(places.begin(), places.end());
  return different.size() == places.size() && (different.empty() || *different.rbegin() < count);
}

Fault search_fault(const SetTraining& sets) {
  if (!are_different(sets.known, sets.columns.size())) return "a first set of effects that there are not";
  if (sets.variations < 0 || sets.variations > kMostVariations) return "no number of variations";
  if (sets.most_causes > kMostSetEffects || sets.most_effects > kMostSetEffects || sets.known.size() > kMostSetEffects)
    return "sets of more effects than the limit, " + std::to_string(kMostSetEffects);
  if (!(sets.most_freedom >= 0.0 && sets.most_freedom <= 1.0)) return "a share outside 0 to 1";
  return std::nullopt;
}

}  // namespace

Fault find_set_fault(const CalibrationData& data) {
  const SetTraining& sets = data.sets;
  const std::size_t effects = sets.columns.size(), columns = sets.moment.size();
  if (effects == 0) return "no effects";
  if (columns > kMostColumns) return "more columns than the limit, " + std::to_string(kMostColumns);
  if (!is_finite_column(sets.gram, columns * columns) || !is_finite_column(sets.moment, columns))
    return "products of columns that are not finite, or not as many as columns";
  if (!is_finite_column(sets.naming_costs_nats, effects) || sets.causes.size() != effects)
    return "not one price and one cause per effect";
  if (std::any_of(sets.columns.begin(), sets.columns.end(), [&](std::uint32_t count) { return count > columns; }) ||
      std::accumulate(sets.columns.begin(), sets.columns.end(), std::size_t{0}) != columns)
    return "effects of more or fewer columns than there are";
  if (sets.cause_names.size() > effects ||
      std::any_of(sets.causes.begin(), sets.causes.end(), [&](auto one) { return one >= sets.cause_names.size(); }))
    return "a cause without a name, or too many names";
  if (!(std::isfinite(sets.squares) && sets.squares > 0.0 && sets.rows > 0.0 && sets.rows <= kMostSetRows &&
        std::isfinite(sets.poses) && sets.poses >= 1.0 && sets.freedom >= 0.0 && sets.freedom <= sets.rows))
    return "counts that no data have";
  const Archipelago& a = data.archipelago;
  if (!data.tables.empty() || a.joints != std::vector<std::uint32_t>{0} || a.demes_per_joint != kSetIslands ||
      a.topology != Topology::ring || a.between_joints || a.asynchronous || a.migration_interval != 1 ||
      data.parameters.number_generations + 1 != static_cast<int>(kSetEpochs) || a.migrants != sets.most_sent())
    return "islands that sets of effects do not have";
  return search_fault(sets);
}

Fault find_fault(const Population& population, const SetTraining& sets) {
  const std::size_t most = std::max<std::size_t>(sets.most_effects, sets.known.size());
  for (const Individual& individual : population) {
    if (!individual.tree.empty()) return "a set of effects with a formula";
    if (individual.effects.size() > most) return "a set of too many effects";
    if (!are_different(individual.effects, sets.columns.size())) return "a set of effects that there are not";
    if (!(individual.fitness >= 0.0)) return "a fitness is negative or not a number";
  }
  return std::nullopt;
}

}  // namespace demecal::inline protocol
