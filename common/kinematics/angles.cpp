#include "kinematics/angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "kinematics/drawn_arm.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline kinematics {
namespace {

/// Controllers round what they report: data this little beyond +-pi still count as quadrant data.
constexpr double kAngleRounding = 1e-6;

}  // namespace

double wrap_near(double angle_rad, double centre_rad) {
  return angle_rad - kTurn_rad * std::round((angle_rad - centre_rad) / kTurn_rad);
}

AngleBranch choose_branch(std::span<const double> angles_rad) {
  std::vector<double> sorted(angles_rad.begin(), angles_rad.end());
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || sorted.front() < -std::numbers::pi - kAngleRounding ||
      sorted.back() > std::numbers::pi + kAngleRounding) {
    return {};
  }
  double widest = kTurn_rad - (sorted.back() - sorted.front());  // the arc through +-pi
  AngleBranch branch;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > widest) {
      widest = gap;
      branch = {true, std::remainder(sorted[i - 1] + gap / 2 + std::numbers::pi, kTurn_rad)};
    }
  }
  return branch;
}

AngleBranch choose_branch(std::span<const double> angles_rad, double lower_rad, double upper_rad) {
  const double travel = upper_rad - lower_rad;
  if (travel <= 0.0 || travel > kTurn_rad) return choose_branch(angles_rad);
  const bool quadrants_suffice =
      lower_rad >= -std::numbers::pi - kAngleRounding && upper_rad <= std::numbers::pi + kAngleRounding;
  return quadrants_suffice ? AngleBranch{} : AngleBranch{true, (lower_rad + upper_rad) / 2};
}

namespace {

/// Angles whose cubes vanish beside one: the closed forms below would divide zero by zero.
constexpr double kSmall = 1e-5;

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector_rad / angle).toRotationMatrix();
}

Eigen::Vector3d vector_of(const Eigen::Matrix3d& rotation) {
  // By way of the quaternion, which keeps all digits both of tiny rotations and near half a turn.
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  return vector_of(to * from.transpose());
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  const Eigen::Matrix3d cross = cross_matrix(vector_rad);
  if (angle < kSmall) return Eigen::Matrix3d::Identity() + cross / 2 + cross * cross / 6;
  const double square = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / square * cross +
         (angle - std::sin(angle)) / (square * angle) * cross * cross;
}

namespace {

/// Angles about the fixed x, y and z, that about y within +-90 deg, as controllers show them.
Eigen::Vector3d about_fixed_xyz(const Eigen::Matrix3d& rotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  const Eigen::Vector3d rpy = origin_of(pose).rpy_rad;
  if (std::abs(rpy.y()) <= std::numbers::pi / 2.0) return rpy;
  const double half = std::numbers::pi;
  return {wrap_near(rpy.x() + half, 0.0), wrap_near(half - rpy.y(), 0.0), wrap_near(rpy.z() + half, 0.0)};
}

/// Angles about x, then the new y, then the new z: those of the inverse, the other way round.
Eigen::Vector3d about_own_xyz(const Eigen::Matrix3d& rotation) {
  return -about_fixed_xyz(rotation.transpose());
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
  const Eigen::Vector3d rpy = about_fixed_xyz(rotation);
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
