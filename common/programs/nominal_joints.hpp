// The joints that a controller comes to for a pose of the tool, by the nominal arm's inverse kinematics.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"
#include "parsed_programs/program.hpp"

namespace demecal::inline programs {

/// Joints at which the nominal arm's tool point (chain.tool_m, axes of the flange) stands at `tool`; nothing where none
/// were found. Of an arm's several configurations: those within the joint limits; of these, those that contradict the
/// hint least; of these, the nearest to the hint's joints or, where it names none, to `reference`. The configurations
/// are searched for from a fixed set of joints, so that a far one may be missed but the answer never varies. `held`
/// joints, from the base on, stay as `reference` (or the hint's) has them.
std::optional<JointVector> nominal_joints(const Chain& arm, const Eigen::Isometry3d& tool, const ArmHint& hint,
                                          const JointVector& reference, int held = 0);

/// Joints near `reference` at which the tool point stands at `point_m`, its orientation free; nothing where there are
/// none.
std::optional<JointVector> joints_at_point(const Chain& arm, const Eigen::Vector3d& point_m,
                                           const JointVector& reference);

/// How many of the signs and quadrants that the hint states these joints contradict, by more than 1e-6 rad.
int contradictions(const ArmHint& hint, const JointVector& joints);

// What searches for joints are made of.
/// Pose of the tool point (axes of the flange) and its Jacobian.
PoseFunction nominal_pose(const Chain& arm);
inline constexpr int kSearchStarts = 48;
/// The `index`-th (from 1) of the joints that searches start from, spread evenly over the joints' limits, but for
/// `held`, from the base on, which stand as `reference` has them.
JointVector search_start(const Chain& arm, int index, const JointVector& reference, int held);
/// The whole turn of a revolute joint's value that is nearest to `reference` or, where that is outside the limits, one
/// nearer to them.
double nearest_turn(const Joint& joint, double value, double reference);
/// The joints in the whole turns that the hint speaks of or, where it does not, that are nearest to `reference`.
JointVector in_hinted_turns(const Chain& arm, JointVector joints, const ArmHint& hint, const JointVector& reference);

/// How far joint `joint` stands outside its limits, rad or m; 0 within them or where none are known (lower not below
/// upper).
double beyond_limits(const Joint& joint, double value);

}  // namespace demecal::inline programs
