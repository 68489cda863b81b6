// What the engine's benchmark evolves: issue-sized symbolic regression of one variable.
#pragma once

#include <cstddef>

#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"

namespace demecal::bench::engine {

/// y = 3 sin t + 1.2 cos 2t - 0.8 t and noise of 0.1, t uniform in [-2.5, 2.5].
TrainingTable smooth_table(std::size_t rows);

/// Population 1000, 50 generations, tournament 5, depth 9, at most 64 nodes, {+ - * % SIN COS SQRTp ABS}; all else as
/// the program's defaults.
GpParameters parameters();
/// The same with ten steps of Levenberg and Marquardt on the constants of every individual, which inherits them.
GpParameters fitting_parameters();

/// Offspring of a run and its first population, equal formulas included.
std::size_t evaluations(const GpParameters& parameters);

}  // namespace demecal::bench::engine
