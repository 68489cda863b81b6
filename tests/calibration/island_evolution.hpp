// Islands in the test's own thread: an evolution of every table of a training, epoch by epoch.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
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

/// An evolver that a function is.
class EvolverFunction final : public Evolver {
 public:
  using Function = std::function<EvolvedJoints(const std::vector<JointTraining>&, const EvolutionTerms&)>;

  explicit EvolverFunction(Function function) : function_(std::move(function)) {}
  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    return function_(trainings, terms);
  }

 private:
  Function function_;
};

/// Finds nothing.
inline EvolvedJoints nothing_evolved(const std::vector<JointTraining>& trainings, const EvolutionTerms& = {}) {
  EvolvedJoints nothing;
  for (const JointTraining& training : trainings) nothing.joints.push_back({training, {}});
  return nothing;
}

/// Evolves formulas over all circumstances; of a joint's own corrections it finds none.
inline EvolverFunction island_evolution(const GpParameters& parameters, std::uint64_t seed) {
  return EvolverFunction([=](const std::vector<JointTraining>& trainings, const EvolutionTerms&) {
    EvolvedJoints evolved;
    for (const JointTraining& training : trainings) {
      const bool formulas = training.table.variables.size() > 1;
      evolved.joints.push_back({training, formulas ? evolved_front(parameters, training, seed) : Population{}});
    }
    return evolved;
  });
}

}  // namespace demecal
