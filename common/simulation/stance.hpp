// How an arm stands, axis by axis, also where its axes tilt in their bearings.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal {

/// Frames of a standing arm in the base frame.
struct Stance {
  std::vector<Eigen::Isometry3d> axes;   ///< per joint: z is its axis, before the joint's own motion
  std::vector<Eigen::Isometry3d> links;  ///< per link: its own frame; the last one is the flange
};

/// Frames of `chain` at joint values `q` (rad or m). `tilts` are rotation vectors (rad), one per joint in its axis
/// frame, by which each axis stands off its nominal direction; empty: none do.
Stance stand(const Chain& chain, const JointVector& q, std::span<const Eigen::Vector3d> tilts = {});

/// The rotation by a rotation vector, rad.
Eigen::Quaterniond rotation_by(const Eigen::Vector3d& vector_rad);

}  // namespace demecal
