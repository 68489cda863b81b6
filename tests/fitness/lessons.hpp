// Training tables and parameters that the tests of evolution share.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// An eccentric gear with a small harmonic: what a joint's error may look like, of order 1.
inline TrainingTable smooth_lesson(std::size_t rows = 30, double phase = 0.4) {
  TrainingTable table{{std::vector<double>(rows)}, std::vector<double>(rows), std::vector<double>(rows, 1.0)};
  for (std::size_t i = 0; i < rows; ++i) {
    const double theta = -2.5 + 5.0 * static_cast<double>(i) / static_cast<double>(rows - 1);
    table.variables[0][i] = theta;
    table.target[i] = 0.7 * std::sin(theta + phase) + 0.2 * std::cos(2.0 * theta) + 0.1;
  }
  return table;
}

/// Of order 1, but a quotient with a pole between two rows fits it best.
inline TrainingTable lesson_with_a_pole(std::size_t rows = 30) {
  TrainingTable table = smooth_lesson(rows);
  for (std::size_t i = 0; i < rows; ++i) table.target[i] = 0.25 / (table.variables[0][i] - 0.3);
  return table;
}

/// Two variables and random targets.
inline TrainingTable two_variable_lesson(RandomStream& random, std::size_t rows = 12) {
  TrainingTable table{{std::vector<double>(rows), std::vector<double>(rows)}, std::vector<double>(rows), {}};
  for (std::size_t i = 0; i < rows; ++i) {
    for (auto& column : table.variables) column[i] = random.real(-3.0, 3.0);
    table.target[i] = random.real(-1.0, 1.0);
    table.weight.push_back(random.real());
  }
  return table;
}

inline GpParameters small_parameters() {
  GpParameters parameters;
  parameters.population_size = 60;
  parameters.number_generations = 24;
  return parameters;
}

}  // namespace demecal
