// One island: a population of correction models that breeds epoch by epoch and exchanges elites with its neighbours.
#pragma once

#include <cstdint>

#include "evolution/archipelago.hpp"
#include "evolution/fitness.hpp"
#include "evolution/individual.hpp"
#include "evolution/parameters.hpp"

namespace demecal {

/// All that an island is between two epochs: with it any worker can go on where another stopped.
struct IslandState {
  std::uint32_t epoch = 0;        ///< epochs completed
  std::uint32_t generation = 0;   ///< generations completed
  std::uint64_t evaluations = 0;
  std::uint64_t migrants_taken = 0;
  Population population;
  Population front;               ///< members of the ParetoFront over all generations
};

/// Figures of the present population, for those who watch.
struct IslandFigures {
  double best = 0.0;
  double median = 0.0;
  std::uint32_t best_length = 0;  ///< nodes
};

/// The work of one island. Its state after epoch k is a function of (parameters, table, seed, key, the migrants it was
/// given): epoch k uses the random stream (seed, joint, deme, k), whoever computes it.
class Island {
 public:
  /// `table` must outlive the island.
  Island(const GpParameters& parameters, const Archipelago& archipelago, const TrainingTable& table, IslandKey key,
         std::uint64_t seed);

  IslandKey key() const { return key_; }
  /// Epoch 0: ramped half-and-half with the neutral model in it (thesis 3.3.3, 4.4.1). Later: `immigrants` replace the
  /// worst individuals (duplicates of residents are left out), then migration_interval generations are bred, or as many
  /// as remain.
  void run_epoch(const Population& immigrants);
  bool finished() const;          ///< all generations are bred
  std::uint32_t epochs_total() const;

  /// The best individuals, at most `migrants`, no two with equal trees.
  Population emigrants() const;
  IslandFigures figures() const;

  const IslandState& state() const { return state_; }
  /// Goes on from a state another worker reached.
  void restore(IslandState state);

 private:
  GpParameters parameters_;
  Archipelago archipelago_;
  Fitness fitness_;
  IslandKey key_;
  std::uint64_t seed_;
  IslandState state_;
};

}  // namespace demecal
