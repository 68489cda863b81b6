// An island of explanations: sets of effects that vary epoch by epoch and exchange the best of every number of causes
// with their neighbours.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "effect_sets/fitted_set.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline effect_sets {

struct ExplanationSearch {
  int variations = 10000;          ///< sets that are made and judged, on all islands
  std::size_t most_causes = 24;    ///< of a set
  std::size_t most_effects = 150;  ///< of a set
  /// Of the freedom that the model leaves, how much a set's columns may take where the first set takes less: more
  /// would explain the noise.
  double most_freedom = 0.25;

  bool operator==(const ExplanationSearch&) const = default;
};

/// What the islands of one search have in common.
struct SetSearch {
  std::vector<std::size_t> known;  ///< the set that they begin with
  ExplanationSearch search;
  std::uint64_t stream = 0;  ///< names their random numbers
};

/// The islands of a search are the demes of joint 0, in a ring.
inline constexpr std::uint32_t kSetIslands = 4;
inline constexpr std::uint32_t kSetEpochs = 10;
/// Sets of every number of causes that an island keeps.
inline constexpr std::size_t kSetsKept = 4;

/// The work of one island. Its state after epoch k is a function of (problem, search, key, the migrants it was given),
/// whoever computes it. Every set is made of one or two others: an effect added, exchanged for another or for a
/// neighbour of its kind; a cause left out; the causes of two sets mixed; then what its causes still lack is added and
/// what does not earn its price is left out. The fitness of a set is its description's length as a share of the
/// residual: exp(nats / rows), 1 for the set of no effect.
class SetIsland {
 public:
  /// `problem` must outlive the island.
  SetIsland(const ExplanationProblem& problem, const SetSearch& search, IslandKey key);

  IslandKey key() const { return key_; }
  /// The first sets: the known one, and what is left of it without the causes that are missed least, one after another.
  void settle();
  /// The same sets at the start of another island's random numbers.
  SetIsland settled_at(IslandKey key) const;
  /// Epoch 0: settles where nobody has. Later: `immigrants` are kept where they are among the best of their number of
  /// causes. Then the island's share of the variations is made. `after_variation` is called after each; where it
  /// throws, the island is left amid the epoch and only restore() or destruction may follow.
  void run_epoch(const Population& immigrants, const std::function<void()>& after_variation = {});
  bool finished() const { return state_.epoch >= kSetEpochs; }

  /// The best of every number of causes.
  std::vector<const FittedSet*> elite() const;
  Population emigrants() const;
  IslandFigures figures() const;
  /// The numbers of the best set's causes, ascending; empty before the first epoch here.
  std::vector<std::size_t> causes_of_best() const;

  const IslandState& state() const { return state_; }
  /// Goes on from a state that another worker reached; its sets are fitted when the next epoch begins.
  void restore(const IslandState& state);

 private:
  static constexpr std::size_t kPromising = 12;  ///< effects among which an addition is drawn

  RandomStream own_stream() const;
  void enter_sets();
  int variations_of_epoch() const;
  bool note(const FittedSet& set);
  const FittedSet& any_kept();
  const FittedSet* best() const;
  std::vector<std::size_t> promising(const FittedSet& set, bool of_its_causes) const;
  void add_promising(FittedSet& set, bool of_its_causes);
  void exchange_neighbour(FittedSet& set);
  void leave_out_a_cause(FittedSet& set);
  FittedSet mixed(const FittedSet& one, const FittedSet& other);
  void fill(FittedSet& set, int most);
  FittedSet varied();
  Individual individual(const FittedSet& set) const;

  const ExplanationProblem& problem_;
  SetSearch search_;
  IslandKey key_;
  RandomStream random_;
  Eigen::Index most_columns_ = 0;
  std::vector<double> prices_nats_;                     ///< of the problem's effects
  std::map<std::size_t, std::vector<FittedSet>> kept_;  ///< by number of causes, the shortest description first
  IslandState state_;
};

/// The set of an individual, fitted afresh.
FittedSet fitted_set(const ExplanationProblem& problem, const Individual& individual);

}  // namespace demecal::inline effect_sets
