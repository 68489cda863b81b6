#include "data_check/axes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "kinematics/rotation_vector.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

std::string axis_name(int axis) {
  return std::string(1, "xyz"[axis]);
}

/// The signed permutation within a tenth of `map`, if there is one.
std::optional<Eigen::Matrix3d> signed_permutation(const Eigen::Matrix3d& map) {
  const Eigen::Matrix3d rounded = map.array().round().matrix();
  if ((map - rounded).cwiseAbs().maxCoeff() > 0.1) return std::nullopt;
  if ((rounded.cwiseAbs().rowwise().sum().array() != 1.0).any()) return std::nullopt;
  return rounded;
}

Explanation named_axes(const Eigen::Matrix3d& permutation) {
  std::string reading;
  bool exchanged = false;
  for (int axis = 0; axis < 3; ++axis) {
    int from = 0;
    permutation.col(axis).cwiseAbs().maxCoeff(&from);
    exchanged = exchanged || from != axis;
    reading += fmt::format("{}{} is {}{}", axis == 0 ? "" : ", ", axis_name(axis),
                           permutation(from, axis) < 0 ? "-" : "", axis_name(from));
  }
  const std::string clause = "the columns of the position are read so: " + reading;
  return {exchanged ? FindingKind::axes_exchanged : FindingKind::mirrored, -1, clause, nullptr};
}

/// The cosine of the angle between the base's z axis and the instrument's where axes `one` and `other` are exchanged
/// in place of y negated.
double upright_if_exchanged(const Eigen::Matrix3d& base, int one, int other) {
  Eigen::Vector3d z = base.col(2);
  z.y() = -z.y();
  std::swap(z[one], z[other]);
  return std::abs(z.z());
}

}  // namespace

Explanation axes_explanation(const Eigen::Isometry3d& sensor_from_base, bool is_base) {
  constexpr double kUpright = 0.87;
  const Eigen::Matrix3d base = sensor_from_base.linear();
  if (is_base) {
    const Eigen::Matrix3d map = Eigen::Vector3d(1, -1, 1).asDiagonal() * base;
    if (const auto permutation = signed_permutation(map)) return named_axes(*permutation);
  }
  if (std::abs(base(2, 2)) < kUpright) {
    for (const auto& [one, other] : {std::pair(1, 2), std::pair(0, 2)}) {
      if (upright_if_exchanged(base, one, other) < kUpright) continue;
      return {FindingKind::axes_exchanged, -1,
              fmt::format("the columns {} and {} of the position are exchanged: the base then stands upright",
                          axis_name(one), axis_name(other)),
              nullptr};
    }
  }
  return {FindingKind::mirrored, -1,
          "one axis of the positions is negated, or two are exchanged (the instrument's frame is left-handed as given)",
          nullptr};
}

std::optional<Explanation> base_frame_explanation(const Eigen::Isometry3d& sensor_from_base) {
  constexpr double kTurn_rad = radians(5.0), kShift_m = 0.05;
  const Eigen::Vector3d turn = vector_of(sensor_from_base.linear());
  if (turn.norm() < kTurn_rad && sensor_from_base.translation().norm() < kShift_m) return std::nullopt;
  const double quarters = turn.norm() / (std::numbers::pi / 2);
  const bool about_z = std::abs(turn.normalized().z()) > 0.99 && std::abs(quarters - std::round(quarters)) < 0.06;
  if (about_z && turn.norm() > 1.0 && sensor_from_base.translation().norm() < kShift_m)
    return Explanation{
        FindingKind::joint_offset, 0,
        fmt::format("{:+g} deg are added to joint 1", 90.0 * std::round(turn.z() / (std::numbers::pi / 2))), nullptr};
  const auto permutation = signed_permutation(sensor_from_base.linear());
  if (permutation && turn.norm() > 1.0 && sensor_from_base.translation().norm() < kShift_m)
    return named_axes(*permutation);
  return Explanation{FindingKind::set_in_other_frame, -1,
                     fmt::format("the base stands {:.0f} mm and {:.1f} deg from where `frame: base` puts it (if the "
                                 "positions are in the instrument's frame, say `frame: sensor`)",
                                 millimetres(sensor_from_base.translation().norm()), degrees(turn.norm())),
                     nullptr};
}

}  // namespace demecal
