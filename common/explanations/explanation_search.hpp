// The search over sets of effects: evolution improves what adding one effect after another has found, and finds the
// best set for every number of causes.
#pragma once

#include <cstddef>
#include <vector>

#include "explanations/fitted_set.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline explanations {

/// A set of effects by their places in the problem, ascending.
struct EffectSet {
  std::vector<std::size_t> effects{};
  std::size_t causes = 0;
  double description_nats = 0.0;  ///< less than without any effect: what it is worth is negative
};

struct ExplanationSearch {
  int variations = 10000;          ///< sets that are made and judged, on all islands
  std::size_t most_causes = 24;    ///< of a set
  std::size_t most_effects = 150;  ///< of a set
  /// Of the freedom that the model leaves, how much a set's columns may take where the first set takes less: more
  /// would explain the noise.
  double most_freedom = 0.25;

  bool operator==(const ExplanationSearch&) const = default;
};

/// For every number of causes that was reached, the set with the shortest description, by number of causes. Every
/// island begins with `known` and what is left of it without one cause after another. Every further set is made of one
/// or two others: an effect added, exchanged for another or for a neighbour of its kind; a cause left out; the causes
/// of two sets mixed; then what its causes still lack is added and what does not earn its price is left out. The best
/// of every number of causes go to the next island from epoch to epoch; within one the islands are independent pieces
/// of work.
std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const std::vector<std::size_t>& known,
                                           const ExplanationSearch& search, RandomStream random);

/// `known`, and what is left of it without the causes that are missed least, one after another: by number of causes.
std::vector<EffectSet> prunings(const ExplanationProblem& problem, const std::vector<std::size_t>& known);

}  // namespace demecal::inline explanations
