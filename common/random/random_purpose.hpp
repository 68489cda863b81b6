// What a program's streams of random numbers are for, one number each.
#pragma once

#include <cstdint>

namespace demecal::inline random {

/// The number that follows the seed in the name of a stream that serves the analysis of data. The numbers are part of
/// every recorded result: new purposes take new ones. Islands name theirs by joint, deme and epoch.
enum class RandomPurpose : std::uint64_t {
  shuffled_approach = 1,     ///< of decoys
  shuffled_temperature = 2,  ///< of decoys
  effect_gain = 3,           ///< bootstrap bound of what one effect gains on the validation poses
  effect_scatter = 4,        ///< scatter of an effect's coefficients
  null_distribution = 5,     ///< draws of the noise behind an effect's p-value
  structure_test = 6,        ///< draws of the noise behind the test for structure
  group_gain = 7,            ///< bootstrap bound of what a group's effects gain together
  next_measurement = 8,      ///< poses that would tell rivals apart
  formula_null = 31,         ///< draws of the noise, searched for formulas as the measured poses are
  proposed_poses = 32,       ///< poses worth measuring next
  cause_cost = 33,           ///< bootstrap interval of what a cause costs
  explanation_search = 34,   ///< variations of sets of effects
  planned_poses = 35,        ///< poses that a plan chooses among, and its way
  workspace_places = 36,     ///< where a model's error over its workspace is predicted
  last_resort = 37,          ///< draws of the noise behind effects that are tried only where all others left structure
  distal_sequence = 406,     ///< distal learning, one joint at a time
  structure_search = 0x5354525543,
};

/// The number that follows the scenario's seed where data are simulated. Names have two parts here; those of the
/// purposes above that share a number have three or four, so that even with one seed for both the streams are apart.
enum class SimulationPurpose : std::uint64_t { poses = 1, noise = 2, payload = 3, repeats = 4 };

constexpr std::uint64_t number_of(RandomPurpose purpose) {
  return static_cast<std::uint64_t>(purpose);
}
constexpr std::uint64_t number_of(SimulationPurpose purpose) {
  return static_cast<std::uint64_t>(purpose);
}

}  // namespace demecal::inline random
