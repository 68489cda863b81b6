// Islands in the test's own thread: an evolution of every table of a training, epoch by epoch.
#pragma once

#include <optional>
#include <vector>

#include "calibration/closed_calibration.hpp"
#include "evolution/island.hpp"

namespace demecal {

/// The front of one table's islands, which stand in a ring.
inline Population evolved_front(const GpParameters& parameters, const JointTraining& training, std::uint64_t seed) {
  Archipelago archipelago;
  archipelago.joints = {training.joint};
  std::vector<Island> ring;
  for (const IslandKey& key : islands(archipelago)) {
    ring.emplace_back(parameters, archipelago, training.table, key, seed);
  }
  while (!ring.front().finished()) {
    std::vector<Population> leaving;
    for (const Island& island : ring) {
      leaving.push_back(island.state().epoch > 0 ? island.emigrants() : Population{});
    }
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i].run_epoch(leaving[(i + ring.size() - 1) % ring.size()]);
  }
  ParetoFront front;
  for (const Island& island : ring) {
    for (const Individual& member : island.state().front) front.offer(member);
  }
  return front.members();
}

/// Evolves formulas over all circumstances; of a joint's own corrections it finds none.
inline Evolve island_evolution(const GpParameters& parameters, std::uint64_t seed) {
  return [=](const std::vector<JointTraining>& trainings, Sought) -> std::optional<std::vector<JointCandidates>> {
    std::vector<JointCandidates> candidates;
    for (const JointTraining& training : trainings) {
      const bool formulas = training.table.variables.size() > 1;
      candidates.push_back({training, formulas ? evolved_front(parameters, training, seed) : Population{}});
    }
    return candidates;
  };
}

}  // namespace demecal
