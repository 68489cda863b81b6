// What must hold for the columns of a data set and for its poses; each rule broken is an InputError.
#pragma once

#include <map>
#include <span>
#include <string>

#include "data/column_map.hpp"
#include "data/column_unit.hpp"
#include "data/pose.hpp"

namespace demecal {

/// Angle for a revolute, length for a prismatic joint.
Quantity joint_quantity(const Joint& joint);

/// As many joint and approach columns as the arm has joints, three of position, four of orientation, no column twice,
/// and something measured.
void check_column_map(const ColumnMap& columns, const Chain& chain);

/// Every target named has its tool point.
void check_targets(std::span<const MeasuredPose> poses, const std::map<std::string, Eigen::Vector3d>& tools_m,
                   const std::string& file);

/// No joint stands further outside its limits than a controller's tolerance explains.
void check_joint_limits(std::span<const MeasuredPose> poses, const Chain& chain, const std::string& file);

/// Poses of one id have equal joints and serve one set: otherwise validation would judge what calibration has seen.
void check_repeats(std::span<const MeasuredPose> poses, const std::string& file);

}  // namespace demecal
