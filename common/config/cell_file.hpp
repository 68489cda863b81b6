// CELL.yaml: where an arm may go and where it can be measured.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "data/data_set.hpp"
#include "planning/cell.hpp"
#include "planning/plan.hpp"

namespace demecal::inline config {

/// What a CELL.yaml says.
struct CellFile {
  WorkCell cell;
  std::map<std::string, Eigen::Vector3d> tools_m;  ///< of several targets; empty: the robot's tool
  std::map<Obstruction, StatedRule> stated;        ///< where it says what poses are refused for
};

/// The cell of an arm. Throws InputError with file, line, value and rule at the first fault.
CellFile load_cell(const std::filesystem::path& path, const Robot& robot);

}  // namespace demecal::inline config
