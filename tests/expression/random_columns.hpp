// Columns of random numbers for formulas to be evaluated over.
#pragma once

#include <cstddef>
#include <vector>

#include "random/random_stream.hpp"

namespace demecal {

/// `count` columns of `rows` numbers in [-largest, largest); the very first is 0, where formulas are at their worst.
inline std::vector<std::vector<double>> random_columns(RandomStream& random, std::size_t count, std::size_t rows,
                                                       double largest = 3.0) {
  std::vector<std::vector<double>> columns(count, std::vector<double>(rows));
  for (std::vector<double>& column : columns) {
    for (double& entry : column) entry = random.real(-largest, largest);
  }
  if (rows > 0) columns.front().front() = 0.0;
  return columns;
}

}  // namespace demecal
