#include "load.hpp"

#include <cmath>

#include "random/random_stream.hpp"

namespace demecal::bench {
namespace {

constexpr int kRows = 30;

TrainingTable table_of(RandomStream random) {
  TrainingTable table{{{}}, {}, {}};
  for (int row = 0; row < kRows; ++row) {
    const double t = random.real(-2.5, 2.5);
    table.variables[0].push_back(t);
    table.target.push_back(3.0 * std::sin(t) + 1.2 * std::cos(2.0 * t) - 0.8 * t + 0.1 * random.normal());
    table.weight.push_back(1.0);
  }
  return table;
}

/// A number that no other run of this benchmark has.
RunId next_run() {
  static RunId run = 0;
  return ++run;
}

CalibrationData run_of(std::uint32_t joints, std::uint32_t demes, std::uint64_t seed) {
  CalibrationData data;
  data.run = next_run();
  data.job = "distribution";
  data.seed = seed;
  data.archipelago.demes_per_joint = demes;
  for (std::uint32_t joint = 0; joint < joints; ++joint) {
    data.archipelago.joints.push_back(joint);
    data.tables.push_back(table_of(RandomStream{seed, joint}));
  }
  return data;
}

}  // namespace

CalibrationData thesis_run(std::uint32_t demes, std::uint64_t seed, int generations) {
  CalibrationData data = run_of(6, demes, seed);
  data.parameters.number_generations = generations;
  return data;
}

CalibrationData sleeping_run(std::uint32_t islands, std::uint32_t epochs, std::uint64_t seed) {
  constexpr std::uint32_t kDemes = 8;
  CalibrationData data = run_of(islands / kDemes, kDemes, seed);
  data.parameters.number_generations = static_cast<int>(epochs);
  data.archipelago.migration_interval = 1;
  data.archipelago.topology = Topology::none;
  data.archipelago.between_joints = true;  // so that no two neighbours are with one worker
  return data;
}

}  // namespace demecal::bench
