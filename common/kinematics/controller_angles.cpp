#include "kinematics/controller_angles.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "kinematics/angles.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline kinematics {
namespace {

/// Angles about x, then the new y, then the new z: the origin's angles of the inverse, the other way round.
Eigen::Vector3d about_own_xyz(const Eigen::Matrix3d& rotation) {
  Eigen::Isometry3d inverse = Eigen::Isometry3d::Identity();
  inverse.linear() = rotation.transpose();
  return -origin_of(inverse).rpy_rad;
}

/// Angles about z, then the new y, then the new z.
Eigen::Vector3d about_own_zyz(const Eigen::Matrix3d& r) {
  const double sine = std::hypot(r(0, 2), r(1, 2));
  const double first = sine > 1e-9 ? std::atan2(r(1, 2), r(0, 2)) : 0.0;
  const double c = std::cos(first), s = std::sin(first);
  return {first, std::atan2(sine, r(2, 2)), std::atan2(c * r(1, 0) - s * r(0, 0), c * r(1, 1) - s * r(0, 1))};
}

std::vector<double> in_degrees(const Eigen::Vector3d& angles_rad) {
  return {degrees(angles_rad[0]), degrees(angles_rad[1]), degrees(angles_rad[2])};
}

}  // namespace

std::vector<ControllerAngles> controller_angles(const Eigen::Matrix3d& rotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  const Eigen::Vector3d rpy = origin_of(pose).rpy_rad;
  const Eigen::Quaterniond turn(rotation);
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d vector = vector_of(rotation);
  return {{"KUKA", "kuka_abc_deg", "A B C deg", in_degrees(rpy.reverse())},
          {"FANUC", "fanuc_wpr_deg", "W P R deg", in_degrees(rpy)},
          {"Yaskawa", "yaskawa_rxryrz_deg", "Rx Ry Rz deg", in_degrees(rpy)},
          {"Staubli", "staubli_rxryrz_deg", "rx ry rz deg", in_degrees(about_own_xyz(rotation))},
          {"Kawasaki", "kawasaki_oat_deg", "O A T deg", in_degrees(about_own_zyz(rotation))},
          {"ABB", "abb_q1q2q3q4", "q1 q2 q3 q4", {sign * turn.w(), sign * turn.x(), sign * turn.y(), sign * turn.z()}},
          {"Universal Robots", "ur_rxryrz_rad", "rx ry rz rad", {vector[0], vector[1], vector[2]}}};
}

}  // namespace demecal::inline kinematics
