// Data sets that are long enough to show what happens in the course of a measurement.
#pragma once

#include <cstdint>
#include <vector>

#include "mistaken_case.hpp"

namespace demecal {

/// Of 150 poses of every arm, that of seven joints among them; without times.
inline std::vector<DataSet> long_measurements(std::uint64_t seed) {
  std::vector<DataSet> all;
  for (const Robot& arm : bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots"))
    all.push_back(bench::unmistaken_cases({arm}, 10, {.seed = seed}).back().data);
  return all;
}

}  // namespace demecal
