// Joint angles without jumps: where a joint's data straddle +-pi they are moved onto one side (thesis 6.2.2). Rotations
// as vectors (axis times angle), how they change with them, and as controllers write them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

namespace demecal::inline kinematics {

/// `angle_rad` moved by whole turns to within half a turn of `centre_rad`.
double wrap_near(double angle_rad, double centre_rad);

/// The branch a joint's data are unwrapped to: every datum is taken as wrap_near(angle, centre) when `wraps`.
struct AngleBranch {
  bool wraps = false;  ///< false: the data are continuous as they stand and are used unchanged
  double centre_rad = 0.0;

  double operator()(double angle_rad) const { return wraps ? wrap_near(angle_rad, centre_rad) : angle_rad; }
};

/// Chooses the branch for a revolute joint's angles: data that all lie within [-pi, pi] (a controller that reports
/// quadrants) and whose widest empty arc does not contain +-pi are re-centred opposite to that arc; data beyond +-pi
/// come from a controller that counts turns and stay as they are.
AngleBranch choose_branch(std::span<const double> angles_rad);

/// The same where the joint's limits are known. Limits less than a turn apart say by themselves where the joint moves,
/// however its data happen to be spread: it does not wrap if they lie within [-pi, pi], and is centred between them
/// otherwise. Limits that are equal (not given) or wider say nothing, and the data decide.
AngleBranch choose_branch(std::span<const double> angles_rad, double lower_rad, double upper_rad);

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

struct ControllerAngles {
  std::string controller;  ///< "KUKA"
  std::string key;         ///< "kuka_abc_deg": for programs
  std::string names;       ///< "A B C deg"
  std::vector<double> values;
};

/// The rotation as each of the controllers that this program knows would show it: angles in deg, UR's vector in rad.
std::vector<ControllerAngles> controller_angles(const Eigen::Matrix3d& rotation);

}  // namespace demecal::inline kinematics
