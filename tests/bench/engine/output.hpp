// The benchmark's figures as a table for people and as JSON lines for programs.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "accuracy.hpp"
#include "measure.hpp"

namespace demecal::bench::engine {

/// What one core can do, in the same run.
struct MachineRates {
  double fma_per_s = 0.0, sin_per_s = 0.0, library_sin_per_s = 0.0;
};

struct EngineRow {
  std::string workload = "run";
  std::size_t rows = 0;
  int threads = 1;
  Speed speed;
  double tree_walk_per_s = 0.0;
  EngineFigures parts;  ///< of one thread's run
};

/// Share of the offspring's functions that their store held already.
double found_in_store(const EngineFigures& figures);
/// Functions computed, times rows, per second of evaluation proper.
double node_rows_per_s(const EngineRow& row);

void write_table(std::ostream& out, const std::vector<EngineRow>& rows, const MachineRates& machine);
void write_json(std::ostream& out, const std::vector<EngineRow>& rows, const MachineRates& machine);

void write_table(std::ostream& out, const std::vector<AccuracyFigures>& seeds);
/// `ms_to_target` is null where the target was never reached.
void write_json(std::ostream& out, const std::vector<AccuracyFigures>& seeds);

}  // namespace demecal::bench::engine
