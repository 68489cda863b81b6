// An individual under evolution, a population of them, its Pareto front, and who of it breeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "expression/tree.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {

/// A formula, or a set of effects.
struct Individual {
  Tree tree;
  double fitness = 0.0;  ///< raw fitness, smaller is better; infinite where the tree has no finite value on some row
  std::vector<std::uint32_t> effects{};  ///< of a set, in the order in which they came; empty where it is a formula

  bool operator==(const Individual&) const = default;
};
using Population = std::vector<Individual>;

/// The best individual of each length (number of nodes) that no shorter one beats: ascending length, falling fitness.
/// At most kMostMembers: where one more would enter, the one that improves least on its shorter neighbour leaves, so
/// that the shortest, the best and those at which a little length buys much stay.
class ParetoFront {
 public:
  static constexpr std::size_t kMostMembers = 64;

  ParetoFront() = default;
  /// Goes on with the members of an earlier front.
  explicit ParetoFront(Population members) : members_(std::move(members)) {}

  /// Whether offer() would enter an individual of `length` nodes.
  bool would_enter(std::size_t length, double fitness) const;
  /// Enters the individual where it belongs and drops what it dominates; at equal fitness the earlier one stays. Not
  /// entered where its fitness is not finite.
  void offer(const Individual& individual);
  const Population& members() const { return members_; }
  Population release() && { return std::move(members_); }

 private:
  Population::const_iterator first_as_long(std::size_t length) const;
  void drop_least_gain();

  Population members_;
};

/// Index of the fittest of `size` individuals drawn uniformly with replacement from a population of the given fitness
/// values; of equals the one drawn first, so that no place in the population is favoured.
std::size_t tournament(RandomStream& random, std::span<const double> fitness, int size);

/// Index of the fittest; of equals the first. The population must not be empty.
std::size_t fittest(std::span<const double> fitness);

/// All indices from the fittest to the worst; equals by index.
std::vector<std::size_t> ranking(std::span<const double> fitness);

}  // namespace demecal::inline evolution
