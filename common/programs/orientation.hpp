// The forms in which programs write orientations, and rotations.
#pragma once

#include "programs/program.hpp"

namespace demecal {

/// The rotation (base from tool) that the numbers write; `form` is not unknown. Numbers are as Cell::inside() gives
/// them.
Eigen::Matrix3d rotation_from(OrientationForm form, const std::vector<double>& numbers);

/// The numbers that write `rotation` in a form other than columns and unknown; of those that do, the ones nearest to
/// `written`, so that a quaternion keeps its sign and angles their turn.
std::vector<double> numbers_of(const Eigen::Matrix3d& rotation, OrientationForm form,
                               const std::vector<double>& written);

}  // namespace demecal
