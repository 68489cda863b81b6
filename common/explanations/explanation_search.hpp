// The search over sets of effects: evolution improves what adding one effect after another has found, and finds the
// best set for every number of causes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "evolution/population.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline explanations {

/// A set of effects by their places in the problem, ascending.
struct EffectSet {
  std::vector<std::size_t> effects{};
  std::size_t causes = 0;
  double description_nats = 0.0;  ///< less than without any effect: what it is worth is negative

  bool operator==(const EffectSet&) const = default;
};

/// What the islands of a search begin with.
SetSearch set_search(const std::vector<std::size_t>& known, const ExplanationSearch& search, RandomStream random);

/// The best of all islands by number of causes; of equals that of the first island.
std::vector<EffectSet> front_of(const ExplanationProblem& problem, const std::vector<Population>& elites);

/// For every number of causes that was reached, the set with the shortest description, by number of causes, from the
/// islands of this search; within an epoch they are independent pieces of work.
std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const SetSearch& search);

/// Who searches: this, or whoever has islands elsewhere, to the bit.
using SearchExplanations = std::function<std::vector<EffectSet>(const ExplanationProblem&, const SetSearch&)>;

/// `known`, and what is left of it without the causes that are missed least, one after another: by number of causes.
std::vector<EffectSet> prunings(const ExplanationProblem& problem, const std::vector<std::size_t>& known);

}  // namespace demecal::inline explanations
