// A run small enough to be bred in a test, and the messages its islands really give.
#pragma once

#include <cmath>

#include "evolution/island.hpp"
#include "protocol/messages.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline CalibrationData small_run() {
  CalibrationData data;
  data.run = 7;
  data.job = "small";
  data.seed = 11;
  data.parameters.population_size = 20;
  data.parameters.number_generations = 7;
  data.archipelago.joints = {0, 2};
  data.archipelago.migration_interval = 3;
  RandomStream random{5};
  for (std::size_t joint = 0; joint < data.archipelago.joints.size(); ++joint) {
    TrainingTable table;
    table.variables.resize(1);
    for (int row = 0; row < 12; ++row) {
      const double theta_rad = random.real(-2.0, 2.0);
      table.variables.front().push_back(theta_rad);
      table.target.push_back(std::sin(theta_rad) + 0.3 * static_cast<double>(joint));
      table.weight.push_back(random.real());
    }
    data.tables.push_back(table);
  }
  return data;
}

inline constexpr IslandKey kSomeIsland{2, 1};

/// The checkpoint after so many epochs of kSomeIsland.
inline Checkpoint checkpoint_after(const CalibrationData& data, std::uint32_t epochs) {
  Island island(data.parameters, data.archipelago, data.tables[1], kSomeIsland, data.seed);
  Checkpoint checkpoint;
  checkpoint.run = data.run;
  checkpoint.island = kSomeIsland;
  while (island.state().epoch < epochs) {
    island.run_epoch({});
    checkpoint.recent.push_back({data.run, kSomeIsland, island.state().epoch, island.emigrants()});
  }
  checkpoint.state = island.state();
  return checkpoint;
}

inline constexpr std::uint32_t kEpochsOfSmallRun = 4;

}  // namespace demecal
