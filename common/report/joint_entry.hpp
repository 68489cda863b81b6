// One joint as the report's JSON has it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expression/interval.hpp"
#include "report/json_value.hpp"

namespace demecal {

struct JointEntry {
  std::uint64_t joint = 0;  ///< from 1
  bool kept = false;        ///< whether the model corrects it
  std::string expression, with_functions, note;
  std::optional<double> before_rad, after_rad, bound_rad;
  std::optional<Interval> range_rad;
  std::vector<double> jumps_rad;  ///< ascending
};

/// The entries of `joints`, in their order. An entry without `kept` counts as corrected where it has an expression.
std::vector<JointEntry> joint_entries(const JsonValue& report);

}  // namespace demecal
