// What tests of islands have in common.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "evolution/island.hpp"
#include "fitness/lessons.hpp"

namespace demecal {

inline std::vector<double> fitness_of(const Population& population) {
  std::vector<double> fitness;
  for (const Individual& one : population) fitness.push_back(one.fitness);
  return fitness;
}

inline bool holds(const Population& population, const Tree& tree) {
  return std::any_of(population.begin(), population.end(), [&](const Individual& one) { return one.tree == tree; });
}

inline Archipelago pair_of_demes() {
  Archipelago archipelago;
  archipelago.joints = {0, 1};
  return archipelago;
}

class IslandTest : public testing::Test {
 protected:
  Island island(IslandKey key, std::uint64_t seed = 5) const {
    return Island(parameters, archipelago, table, key, seed);
  }
  Island finished(IslandKey key, std::uint64_t seed = 5) const {
    Island one = island(key, seed);
    while (!one.finished()) one.run_epoch({});
    return one;
  }

  GpParameters parameters = small_parameters();
  Archipelago archipelago = pair_of_demes();
  TrainingTable table = smooth_lesson();
};

}  // namespace demecal
