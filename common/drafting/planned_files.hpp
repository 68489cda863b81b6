// The files that plans and proposals of poses leave to be filled in by what is measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "planning/plan.hpp"

namespace demecal::inline drafting {

/// poses.csv of a plan: set, pose_id, joints, approach and, where there are several, targets; what is measured is
/// added.
std::string planned_poses_csv(const Plan& plan, const PlanRequest& request);
/// The DATASET.yaml for it, once it has columns for what was measured.
std::string planned_data_set_text(const Plan& plan, const PlanRequest& request);
/// The JOB.yaml for that; `measured_file`: the data set that the plan goes on from, as seen from its folder, or empty.
std::string planned_job_text(const PlanRequest& request, const std::filesystem::path& measured_file = {});

/// The CSV of `stops`: their ids "N1" onwards, the commanded joints in the names and units of the columns of the data
/// set file, the side each joint is to be approached from, and the payload where one was recorded. Angles and lengths
/// are rounded to what a controller takes.
std::string proposed_poses_csv(const std::filesystem::path& data_set_file, const DataSet& data,
                               const std::vector<Stop>& stops);

}  // namespace demecal::inline drafting
