// What several methods make of the same poses, side by side, for people and for machines.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "effects/measurement.hpp"

namespace demecal {

struct ComparedMethod {
  std::string key, title;
  std::array<ErrorFigures, 3> figures{};  ///< on calibration, validation and accept poses
  int parameters = 0;                     ///< numbers identified
  double wall_s = 0.0;
  std::string chosen{};  ///< by cross-validation, or why there are no figures
};

struct Comparison {
  std::string job, robot, data, data_sha256;
  std::array<std::size_t, 3> poses{};  ///< of calibration, validation, accept
  std::vector<ComparedMethod> methods;
};

/// A line per method: validation and accept error, numbers identified, time. At most 100 columns wide.
std::string comparison_table(const Comparison& comparison);

/// {"demecal_comparison": 1, ..., "methods": [{"method", "title", "parameters", "wall_s", "chosen", "error_mm"}]}, on
/// one line, or with an indent where that is not negative; figures that do not exist are null.
std::string comparison_json(const Comparison& comparison, int indent = -1);

}  // namespace demecal
