// The forms in which programs write orientations, and rotations.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace demecal::inline parsed_programs {

/// How a file writes the tool's orientation.
enum class OrientationForm {
  unknown,           ///< not at all
  columns,           ///< nine numbers, the frame's x, y and z axes one after the other; they are read and kept
  quaternion,        ///< w, x, y, z
  zyx_angles,        ///< about z, then the new y, then the new x
  fixed_xyz_angles,  ///< about x, then y, then z, all of them axes that stay
  xyz_angles,        ///< about x, then the new y, then the new z
  zyz_angles,        ///< about z, then the new y, then the new z
  rotation_vector,   ///< axis times angle
};

/// The rotation (base from tool) that the numbers write; `form` is not unknown. Numbers are as Cell::inside() gives
/// them.
Eigen::Matrix3d rotation_from(OrientationForm form, const std::vector<double>& numbers);

/// The numbers that write `rotation` in a form other than columns and unknown; of those that do, the ones nearest to
/// `written`, so that a quaternion keeps its sign and angles their turn.
std::vector<double> numbers_of(const Eigen::Matrix3d& rotation, OrientationForm form,
                               const std::vector<double>& written);

}  // namespace demecal::inline parsed_programs
