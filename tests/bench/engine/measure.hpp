// Runs of the engine under a clock, and the same formulas by a plain evaluator.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fitness/parameters.hpp"

namespace demecal::bench::engine {

/// Seconds that the parts of a run took.
struct TimeSplit {
  double start = 0.0, variation = 0.0, binding = 0.0, evaluation = 0.0, fitness = 0.0, fitting = 0.0;
  double total() const { return start + variation + binding + evaluation + fitness + fitting; }
};

/// One island's run, part by part.
struct EngineFigures {
  TimeSplit seconds;
  double functions = 0.0;           ///< of all offspring as trees
  double functions_made = 0.0;      ///< of those, not found in the store
  double functions_computed = 0.0;  ///< over all rows
  double nodes = 0.0;               ///< of all offspring as trees, terminals included
  double fits = 0.0;                ///< formulas whose constants were fitted, equal ones once
  std::size_t bytes = 0;            ///< of store, columns and what is known of nodes
};

/// The best of `runs` runs; `error_rows_per_s` divides the time of evaluation into values and fitness.
EngineFigures measure_parts(const GpParameters& gp, std::size_t rows, int runs, double error_rows_per_s);

/// Whole runs of Island, one a thread, side by side: evaluations per second of processor time (one thread's) and of
/// the wall clock (all threads'), the best of `runs`.
struct Speed {
  double per_thread_second = 0.0;
  double per_wall_second = 0.0;
};
Speed measure_runs(const GpParameters& gp, std::size_t rows, int threads, int runs);

/// Evaluations per second of the formulas of one run's last population by a recursive evaluator, row by row.
double measure_tree_walk(std::size_t rows);

}  // namespace demecal::bench::engine
