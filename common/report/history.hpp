// Tables beside a report: the course of evolution, with a row per joint, island and epoch, or step of distal learning,
// and its curves; and every pose.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibration/admissible.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "report/report.hpp"

namespace demecal::inline report {

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
std::string distal_csv(const std::vector<DistalEntry>& steps);

/// CSV with header joint,nodes,mean_abs_error_rad,bound_rad,jumps,expression; joints count from 1.
std::string fronts_csv(const std::vector<EvolvedCorrection>& fronts);

struct FitnessPoint {
  double generation = 0.0;
  double best = 0.0;  ///< finite, smaller is better
};

/// One joint's islands by their number, from 1; points in the order of the history's rows.
using FitnessCurves = std::map<std::uint64_t, std::vector<FitnessPoint>>;

/// The best fitness of every island over the generations.
struct FitnessHistory {
  std::map<std::uint64_t, FitnessCurves> joints;  ///< by their number, from 1
  double lowest = 0.0, highest = 0.0;             ///< of all points above 0; both 1 where there are none
};

/// Rows whose fitness is infinite or no number are left out.
FitnessHistory fitness_of(const std::vector<HistoryRow>& rows);

/// The same of what history_csv() wrote; no joints where `csv` has no rows. Throws InputError naming history.csv, line
/// and value where a column is missing or a field is no number.
FitnessHistory read_fitness(const std::string& csv);

/// Names come from files: a table has them on one line.
std::string on_one_line(std::string name);

/// pose-errors.csv: id, target, set, errors, radius, flags, joints, measured position, error by axis before and after,
/// temperature and time; what no pose has is left out, what one pose lacks is empty.
std::string pose_errors_csv(const Report& report);

}  // namespace demecal::inline report
