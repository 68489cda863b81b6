#include "parsed_programs/orientation.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "errors/check.hpp"
#include "kinematics/angles.hpp"

namespace demecal::inline parsed_programs {
namespace {

double distance(const std::vector<double>& one, const std::vector<double>& other) {
  double square = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) square += (one[i] - other[i]) * (one[i] - other[i]);
  return std::sqrt(square);
}

/// The nine numbers as axes, made orthonormal whatever they are scaled by and rounded to.
Eigen::Matrix3d from_columns(const std::vector<double>& numbers) {
  Eigen::Matrix3d axes;
  for (Eigen::Index i = 0; i < 9; ++i) axes(i % 3, i / 3) = numbers[static_cast<std::size_t>(i)];
  const Eigen::Matrix3d scaled = axes / axes.col(0).norm();
  return Eigen::Quaterniond(scaled).normalized().toRotationMatrix();
}

std::vector<double> quaternion_of(const Eigen::Matrix3d& rotation, const std::vector<double>& written) {
  const Eigen::Quaterniond turn(rotation);
  const std::vector<double> same{turn.w(), turn.x(), turn.y(), turn.z()};
  const std::vector<double> opposite{-turn.w(), -turn.x(), -turn.y(), -turn.z()};
  return distance(opposite, written) < distance(same, written) ? opposite : same;
}

/// Of the two triples of angles that any rotation has, and their whole turns, the nearest. Where the second angle is a
/// right one the first keeps its value.
std::vector<double> angles_of(const Eigen::Matrix3d& rotation, const std::vector<double>& written) {
  const double cosine = std::hypot(rotation(0, 0), rotation(1, 0));
  const double first = cosine > 1e-12 ? std::atan2(rotation(1, 0), rotation(0, 0)) : written[0];
  const double second = std::atan2(-rotation(2, 0), cosine);
  const Eigen::Matrix3d rest =
      (Eigen::AngleAxisd(first, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(second, Eigen::Vector3d::UnitY()))
          .toRotationMatrix()
          .transpose() *
      rotation;
  const double third = std::atan2(rest(2, 1), rest(1, 1));
  const auto near = [&](double a, double b, double c) {
    return std::vector<double>{wrap_near(a, written[0]), wrap_near(b, written[1]), wrap_near(c, written[2])};
  };
  const std::vector<double> one = near(first, second, third),
                            other = near(first + std::numbers::pi, std::numbers::pi - second, third + std::numbers::pi);
  return distance(other, written) < distance(one, written) ? other : one;
}

std::vector<double> reversed(const std::vector<double>& angles, double sign) {
  return {sign * angles[2], sign * angles[1], sign * angles[0]};
}

/// The same about z, y and z again; where the second angle is zero the first keeps its value.
std::vector<double> zyz_angles_of(const Eigen::Matrix3d& rotation, const std::vector<double>& written) {
  const double sine = std::hypot(rotation(0, 2), rotation(1, 2));
  const double first = sine > 1e-12 ? std::atan2(rotation(1, 2), rotation(0, 2)) : written[0];
  const double second = std::atan2(sine, rotation(2, 2));
  const Eigen::Matrix3d rest =
      (Eigen::AngleAxisd(first, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(second, Eigen::Vector3d::UnitY()))
          .toRotationMatrix()
          .transpose() *
      rotation;
  const double third = std::atan2(rest(1, 0), rest(0, 0));
  std::vector<double> nearest;
  for (const double side : {1.0, -1.0}) {
    const double turned = side > 0.0 ? 0.0 : std::numbers::pi;
    const std::vector<double> angles{wrap_near(first + turned, written[0]), wrap_near(side * second, written[1]),
                                     wrap_near(third + turned, written[2])};
    if (nearest.empty() || distance(angles, written) < distance(nearest, written)) nearest = angles;
  }
  return nearest;
}

/// Vectors of one direction that differ by whole turns turn the same way; the nearest of those within one turn.
std::vector<double> vector_numbers(const Eigen::Matrix3d& rotation, const std::vector<double>& written) {
  const Eigen::Vector3d shortest = vector_of(rotation);
  const Eigen::Vector3d before(written[0], written[1], written[2]);
  const double angle = shortest.norm();
  const Eigen::Vector3d axis = angle > 1e-12 ? Eigen::Vector3d(shortest / angle) : Eigen::Vector3d(before.normalized());
  Eigen::Vector3d nearest = shortest;
  for (const double turns : {-1.0, 1.0}) {
    const Eigen::Vector3d turned = shortest + turns * 2.0 * std::numbers::pi * axis;
    if ((turned - before).norm() < (nearest - before).norm()) nearest = turned;
  }
  return {nearest.x(), nearest.y(), nearest.z()};
}

}  // namespace

Eigen::Matrix3d rotation_from(OrientationForm form, const std::vector<double>& numbers) {
  switch (form) {
    case OrientationForm::columns:
      return from_columns(numbers);
    case OrientationForm::quaternion:
      return Eigen::Quaterniond(numbers[0], numbers[1], numbers[2], numbers[3]).normalized().toRotationMatrix();
    case OrientationForm::zyx_angles:
      return (Eigen::AngleAxisd(numbers[0], Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(numbers[1], Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(numbers[2], Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
    case OrientationForm::fixed_xyz_angles:
      return rotation_from(OrientationForm::zyx_angles, reversed(numbers, 1.0));
    case OrientationForm::xyz_angles:
      return rotation_from(OrientationForm::zyx_angles, reversed(numbers, -1.0)).transpose();
    case OrientationForm::zyz_angles:
      return (Eigen::AngleAxisd(numbers[0], Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(numbers[1], Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(numbers[2], Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
    case OrientationForm::rotation_vector:
      return rotation_of({numbers[0], numbers[1], numbers[2]});
    case OrientationForm::unknown:
      break;
  }
  DEMECAL_CHECK(false, "no orientation");
  return Eigen::Matrix3d::Identity();
}

std::vector<double> numbers_of(const Eigen::Matrix3d& rotation, OrientationForm form,
                               const std::vector<double>& written) {
  if (form == OrientationForm::quaternion) return quaternion_of(rotation, written);
  if (form == OrientationForm::zyx_angles) return angles_of(rotation, written);
  if (form == OrientationForm::fixed_xyz_angles) return reversed(angles_of(rotation, reversed(written, 1.0)), 1.0);
  if (form == OrientationForm::xyz_angles)
    return reversed(angles_of(rotation.transpose(), reversed(written, -1.0)), -1.0);
  if (form == OrientationForm::zyz_angles) return zyz_angles_of(rotation, written);
  DEMECAL_CHECK(form == OrientationForm::rotation_vector, "a form that is kept");
  return vector_numbers(rotation, written);
}

}  // namespace demecal::inline parsed_programs
