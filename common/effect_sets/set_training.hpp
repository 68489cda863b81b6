// What islands of explanations learn from, as plain numbers that travel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"

namespace demecal::inline effect_sets {

/// What a cause is called, for people.
struct CauseName {
  std::string text;

  bool operator==(const CauseName&) const = default;
};

/// An ExplanationProblem and a SetSearch.
struct SetTraining {
  std::vector<double> gram;    ///< column by column
  std::vector<double> moment;  ///< one per column
  double squares = 0.0, rows = 0.0, freedom = 0.0, poses = 0.0;
  std::vector<std::uint32_t> columns;     ///< how many each effect has, one effect after another
  std::vector<double> naming_costs_nats;  ///< of each effect
  std::vector<std::uint32_t> causes;      ///< of each effect, places among the names
  std::vector<CauseName> cause_names;
  std::vector<std::uint32_t> known;  ///< the first set
  int variations = 0;                ///< on all islands
  std::uint32_t most_causes = 0, most_effects = 0;
  double most_freedom = 0.0;
  std::uint64_t stream = 0;

  /// Sets that an island keeps at most, and sends at most per epoch.
  std::size_t most_kept() const { return kSetsKept * most_sent(); }
  std::size_t most_sent() const { return cause_names.size() + 1; }
  /// Random numbers that an island draws at most: a variation takes fewer than sixteen, and one for each cause mixed.
  std::uint64_t most_draws() const { return static_cast<std::uint64_t>(variations) * (16 + cause_names.size()); }

  bool operator==(const SetTraining&) const = default;
};

SetTraining set_training(const ExplanationProblem& problem, const SetSearch& search);
/// As it was, to the bit. `training` is consistent: see find_fault().
ExplanationProblem problem_of(const SetTraining& training);
SetSearch search_of(const SetTraining& training);

}  // namespace demecal::inline effect_sets
