// The best fitness of every island over the generations, read back from the history.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace demecal {

struct FitnessPoint {
  double generation = 0.0;
  double best = 0.0;  ///< finite, smaller is better
};

/// One joint's islands by their number, from 1; points in the order of the history's rows.
using FitnessCurves = std::map<std::uint64_t, std::vector<FitnessPoint>>;

struct FitnessHistory {
  std::map<std::uint64_t, FitnessCurves> joints;  ///< by their number, from 1
  double lowest = 0.0, highest = 0.0;             ///< of all points above 0; both 1 where there are none
};

/// What history_csv() wrote; no joints where `csv` has no rows. Rows whose fitness is infinite or no number are left
/// out. Throws InputError naming history.csv, line and value where a column is missing or a field is no number.
FitnessHistory read_fitness(const std::string& csv);

}  // namespace demecal
