// CELL.yaml: where an arm may go and where it can be measured; and the files that a plan leaves to be filled in.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "data/data_set.hpp"
#include "planning/plan.hpp"

namespace demecal::inline config {

/// What a CELL.yaml says.
struct CellFile {
  WorkCell cell;
  std::map<std::string, Eigen::Vector3d> tools_m;  ///< of several targets; empty: the robot's tool
};

/// The cell of an arm. Throws InputError with file, line, value and rule at the first fault.
CellFile load_cell(const std::filesystem::path& path, const Robot& robot);

/// poses.csv of a plan: set, pose_id, joints, approach and, where there are several, targets; what is measured is
/// added.
std::string planned_poses_csv(const Plan& plan, const PlanRequest& request);
/// The DATASET.yaml for it, once it has columns for what was measured.
std::string planned_data_set_text(const Plan& plan, const PlanRequest& request);
/// The JOB.yaml for that.
std::string planned_job_text(const PlanRequest& request);

}  // namespace demecal::inline config
