#include "kinematics/chain.hpp"
#include "programs/configuration.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "kinematics/forward.hpp"

namespace demecal::inline programs {
namespace {

constexpr std::size_t kSix = 6;

struct JointAxis {
  Eigen::Vector3d point, direction;
};

std::array<JointAxis, kSix> axes_at(const Chain& arm, const JointVector& joints) {
  Chain uncoupled = arm;
  uncoupled.couplings.clear();
  const JointVector turns = driven_joints(arm, joints);
  const Eigen::Vector3d flange = forward(uncoupled, turns).translation();
  const Jacobian jacobian = joint_jacobian(uncoupled, turns, Eigen::Vector3d::Zero());
  std::array<JointAxis, kSix> axes;
  const Eigen::Index rails = jacobian.cols() - static_cast<Eigen::Index>(kSix);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto column = jacobian.col(rails + static_cast<Eigen::Index>(i));
    const Eigen::Vector3d velocity = column.head<3>(), direction = column.tail<3>();
    axes[i] = {flange - velocity.cross(direction), direction};
  }
  return axes;
}

double distance_from_axis(const JointAxis& axis, const Eigen::Vector3d& point) {
  return (point - axis.point).cross(axis.direction).norm();
}

/// Where axes 4 and 5, which cross, come closest, on axis 5.
Eigen::Vector3d wrist_of(const std::array<JointAxis, kSix>& axes) {
  const JointAxis &fourth = axes[3], &fifth = axes[4];
  const Eigen::Vector3d across = fourth.direction.cross(fifth.direction);
  const double along =
      (fourth.point - fifth.point).cross(fourth.direction).dot(across) / std::max(across.squaredNorm(), 1e-12);
  return fifth.point - along * fifth.direction;
}

double wrist_sine(const std::array<JointAxis, kSix>& axes) {
  return axes[3].direction.cross(axes[5].direction).dot(axes[4].direction);
}

/// Behind rails, or none.
bool has_six_axes(const Chain& arm) {
  const auto first = std::ranges::find_if(arm.joints, [](const Joint& joint) { return is_revolute(joint); });
  return arm.joints.end() - first == kSix &&
         std::all_of(first, arm.joints.end(), [](const Joint& joint) { return is_revolute(joint); });
}

/// The sines of shoulder, elbow and wrist; nothing where the arm has none.
std::optional<std::array<double, 3>> sides_of(const Chain& arm, const JointVector& joints) {
  constexpr double kMeet_m = 1e-3, kParallel = 1e-3, kCross = 0.5;
  const std::array<JointAxis, kSix> axes = axes_at(arm, joints);
  const Eigen::Vector3d wrist = wrist_of(axes), forward_side = axes[0].direction.cross(axes[1].direction);
  const bool spherical = distance_from_axis(axes[3], wrist) < kMeet_m && distance_from_axis(axes[5], wrist) < kMeet_m;
  const bool planar = axes[1].direction.cross(axes[2].direction).norm() < kParallel && forward_side.norm() > kCross;
  if (!spherical || !planar) return std::nullopt;
  const auto in_plane = [&](const Eigen::Vector3d& way) {
    return Eigen::Vector3d(way - way.dot(axes[1].direction) * axes[1].direction);
  };
  const Eigen::Vector3d upper = in_plane(axes[2].point - axes[1].point), fore = in_plane(wrist - axes[2].point);
  const double lengths = std::max(upper.norm() * fore.norm(), 1e-12), reach = upper.norm() + fore.norm();
  return std::array<double, 3>{(wrist - axes[0].point).dot(forward_side.normalized()) / std::max(reach, 1e-12),
                               axes[1].direction.dot(upper.cross(fore)) / lengths, wrist_sine(axes)};
}

bool are_parallel(const JointAxis& one, const JointAxis& other) {
  constexpr double kParallel = 1e-6;
  return one.direction.cross(other.direction).norm() < kParallel;
}

bool meet(const JointAxis& one, const JointAxis& other) {
  constexpr double kCross = 1e-3, kMeet_m = 1e-6;
  const Eigen::Vector3d across = one.direction.cross(other.direction);
  return across.norm() > kCross && std::abs((one.point - other.point).dot(across)) < kMeet_m * across.norm();
}

}  // namespace

std::size_t most_configurations(const Chain& arm, const JointVector& joints) {
  constexpr std::size_t kOfMostArms = 8, kOfAll = 16;
  constexpr double kMeet_m = 1e-6;
  if (!has_six_axes(arm)) return kOfAll;
  const std::array<JointAxis, kSix> axes = axes_at(arm, joints);
  const bool spherical = meet(axes[3], axes[4]) && distance_from_axis(axes[5], wrist_of(axes)) < kMeet_m;
  const bool planar = are_parallel(axes[1], axes[2]) && are_parallel(axes[2], axes[3]) && meet(axes[4], axes[5]);
  return spherical || planar ? kOfMostArms : kOfAll;
}

std::optional<bool> same_side(const Chain& arm, const JointVector& one, const JointVector& other, std::size_t part) {
  constexpr double kTold = 0.02;
  if (!has_six_axes(arm)) return std::nullopt;
  const auto sides = sides_of(arm, one), others = sides_of(arm, other);
  if (!sides || !others) return std::nullopt;
  const double side = (*sides)[part], other_side = (*others)[part];
  if (std::abs(side) < kTold || std::abs(other_side) < kTold) return std::nullopt;
  return (side > 0.0) == (other_side > 0.0);
}

std::optional<bool> same_posture(const Chain& arm, const JointVector& one, const JointVector& other) {
  bool same = true;
  for (std::size_t part = 0; part < 3; ++part) {
    const std::optional<bool> on_one_side = same_side(arm, one, other, part);
    if (!on_one_side) return std::nullopt;
    same = same && *on_one_side;
  }
  return same;
}

bool leaves_side(const Chain& arm, const JointVector& one, const JointVector& other, std::size_t part) {
  constexpr double kZero = 1e-7;
  if (!has_six_axes(arm)) return false;
  const auto sides = sides_of(arm, one), others = sides_of(arm, other);
  if ((!sides || !others) && part != 2) return false;
  const double side = sides ? (*sides)[part] : wrist_sine(axes_at(arm, one));
  const double other_side = others ? (*others)[part] : wrist_sine(axes_at(arm, other));
  return side * other_side <= 0.0 && std::abs(side - other_side) > kZero;
}

}  // namespace demecal::inline programs
