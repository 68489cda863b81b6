// The course of evolution as tables: one row per joint, island and epoch; of distal learning one per step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/distal_steps.hpp"
#include "evolution/island.hpp"

namespace demecal {

struct HistoryRow {
  IslandKey island;
  std::uint32_t generation = 0;
  IslandFigures figures;
  std::uint64_t evaluations = 0;
  std::uint64_t migrants_taken = 0;
  std::string worker;
};

/// CSV with header joint,island,generation,best_fitness,median_fitness,best_length,evaluations,migrants_taken,worker;
/// joints and islands count from 1, fitness in units of the joint's scale.
std::string history_csv(const std::vector<HistoryRow>& rows);

/// CSV with header joint,generation,expression,index_mm2 (thesis Table 4-1); joints count from 1, the expression is
/// g(theta) in rad.
std::string distal_csv(const std::vector<DistalStep>& steps);

}  // namespace demecal
