#include "kinematics/rotation_vector.hpp"

#include <cmath>

namespace demecal::inline kinematics {
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

}  // namespace demecal::inline kinematics
