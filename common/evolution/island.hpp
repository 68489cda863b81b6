// One island: a population of correction models that breeds epoch by epoch and exchanges elites with its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "evolution/archipelago.hpp"
#include "evolution/breeding.hpp"
#include "evolution/population.hpp"
#include "expression/tree.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline evolution {

/// All that an island is between two epochs: with it any worker can go on where another stopped.
struct IslandState {
  std::uint32_t epoch = 0;       ///< epochs completed
  std::uint32_t generation = 0;  ///< generations completed
  std::uint64_t evaluations = 0;
  std::uint64_t migrants_taken = 0;
  Population population;
  Population front;                ///< members of the ParetoFront over all generations
  std::uint32_t without_gain = 0;  ///< epochs since its best grew better or the population began anew
  std::uint64_t draws = 0;         ///< of random numbers, where one stream goes on from epoch to epoch
  std::vector<double> numbers{};   ///< that were drawn, where nothing is bred

  bool operator==(const IslandState&) const = default;
};

/// Figures of the present population, for those who watch.
struct IslandFigures {
  double best = 0.0;
  double median = 0.0;            ///< the lower one where the population is even
  std::uint32_t best_length = 0;  ///< nodes, or effects of a set
  double diversity = 0.0;         ///< share of trees that differ from all before them, to the bit; 0 to 1

  bool operator==(const IslandFigures&) const = default;
};

/// The work of one island. Between epochs its formulas are trees; within, they share their subtrees. Its state after
/// epoch k is a function of (parameters, table, seed, key, the migrants it was given): epoch k uses the random stream
/// (seed, joint, deme, k), whoever computes it.
class Island {
 public:
  /// `table` must outlive the island.
  Island(const GpParameters& parameters, const Archipelago& archipelago, const TrainingTable& table, IslandKey key,
         std::uint64_t seed);

  IslandKey key() const { return key_; }
  /// Epoch 0: ramped half-and-half with the neutral model in it (thesis 3.3.3, 4.4.1), the table's seeds in place of
  /// the last of it; no generation is bred. Later: after restart_after epochs without gain a population as the first
  /// takes the place of all residents (the front stays); then `immigrants` replace residents, the worst or any, and
  /// migration_interval generations are bred, or as many as remain. Immigrants are evaluated on this island's table;
  /// duplicates of residents and trees that do not fit it (too deep, or of variables it lacks) are left out; the best
  /// resident is never replaced. Formulas that may break the table's limit (see SafeFormulas) do not enter the front;
  /// where they would, or are the fittest, or would leave as emigrants, they lose their fitness. Must not be finished.
  /// `after_generation` is called after each; where it throws, the island is left amid the epoch and only restore() or
  /// destruction may follow.
  void run_epoch(const Population& immigrants, const std::function<void()>& after_generation = {});
  bool finished() const;               ///< all generations are bred
  std::uint32_t epochs_total() const;  ///< the first, and as many as number_generations takes

  /// The best individuals, at most `migrants`, no two with equal trees, all of finite fitness.
  Population emigrants() const;
  IslandFigures figures() const;
  /// The fittest resident, whose figures these are; null before the first epoch.
  const Individual* best() const;

  const IslandState& state() const { return state_; }
  /// Goes on from a state another worker reached; its fitness values are taken as they are.
  void restore(IslandState state);

 private:
  std::vector<Tree> first_trees(RandomStream& random) const;
  void enter_population(RandomStream& random);
  void accept_immigrants(const Population& immigrants, RandomStream& random);
  bool is_stagnant() const;
  void offer_all(ParetoFront& front);
  void reject_unsafe(std::size_t most);
  void write_population();
  void forget_models();
  bool fits(const Tree& tree) const;
  std::uint32_t generations_of_epoch() const;

  GpParameters parameters_;
  Archipelago archipelago_;
  int variables_;
  std::vector<Tree> seeds_;
  Breeder breeder_;
  SharedPopulation residents_;  ///< the population during an epoch, and after it; empty where it is not known yet
  IslandKey key_;
  std::uint64_t seed_;
  IslandState state_;
};

}  // namespace demecal::inline evolution
