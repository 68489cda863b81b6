// A table of a wave of two variables, noisy.
#pragma once

#include <cmath>

#include "expression/text.hpp"
#include "fitness/fitness.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline const VariableNames kNames{"q1", "q2"};

/// Rows of sin(factor q1 + 2 q2) with noise, of weight 1.
inline TrainingTable table_of(double factor, double noise, std::uint64_t seed) {
  RandomStream random{71, seed};
  TrainingTable table;
  table.variables.resize(2);
  for (int row = 0; row < 200; ++row) {
    const double q1 = random.real(-2.0, 2.0), q2 = random.real(-2.0, 2.0);
    table.variables[0].push_back(q1);
    table.variables[1].push_back(q2);
    table.target.push_back(std::sin(factor * q1 + 2.0 * q2) + noise * random.normal());
    table.weight.push_back(1.0);
  }
  return table;
}

}  // namespace demecal
