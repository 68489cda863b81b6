// Rotations as vectors (axis times angle), and how they change with them.
#pragma once

#include <Eigen/Geometry>

namespace demecal::inline kinematics {

/// The matrix whose product with w is v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// The matrix that turns about `vector_rad` by its length.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector_rad);

/// The vector of a rotation, rad, of length at most pi.
Eigen::Vector3d vector_of(const Eigen::Matrix3d& rotation);

/// The rotation vector (rad, in the frame both are given in) that takes `from` to `to`.
Eigen::Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to);

/// The left Jacobian of SO(3): a small change dw of `vector_rad` turns rotation_of(vector_rad) by left_jacobian * dw,
/// in the frame it turns in (Chirikjian, 2012, eq. 10.86).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& vector_rad);

}  // namespace demecal::inline kinematics
