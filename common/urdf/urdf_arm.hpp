// The serial arm between two links of a URDF.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/urdf_file.hpp"

namespace demecal::inline urdf {

struct UrdfArm {
  std::string base, tip;  ///< links
  DrawnArm drawing;  ///< by axes; fixed joints are part of the next moving joint's origin, the last ones the flange
  std::vector<const UrdfJoint*> joints;   ///< the moving joints, of the file that was read
  std::vector<Eigen::Isometry3d> before;  ///< of every moving joint: the fixed places before its own origin
  std::vector<LinkMass> masses;    ///< of what moves with each joint, in its child link's frame; empty: not stated
  std::vector<std::string> notes;  ///< sentences: what was assumed
};

/// The arm from `base` (the root link where it is not given) to `tip` (the one link that the arm ends at). Throws
/// InputError where links are unknown, several could be meant, or what lies between them is no serial arm. `urdf` must
/// outlive the result.
UrdfArm arm_between(const UrdfFile& urdf, const std::optional<std::string>& base,
                    const std::optional<std::string>& tip);

}  // namespace demecal::inline urdf
