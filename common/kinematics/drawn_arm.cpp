#include "kinematics/drawn_arm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "errors/check.hpp"
#include "kinematics/angles.hpp"

namespace demecal::inline kinematics {
namespace {

constexpr double kNearParallel = 0.02;    ///< sine of the twist below which a common normal has no certain place
constexpr double kDrawnRounding = 1e-13;  ///< rad or m, below what any drawing means

double without_rounding(double value) {
  return std::abs(value) < kDrawnRounding ? 0.0 : value;
}

Eigen::Isometry3d turned(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle_rad, axis));
}

/// What the joint's own value does in its frame.
Eigen::Isometry3d motion(const DrawnJoint& joint, double value) {
  const Eigen::Vector3d axis = joint.axis.normalized();
  if (is_revolute(joint.row)) return turned(value, axis);
  return Eigen::Isometry3d(Eigen::Translation3d(value * axis));
}

/// The shortest turn that takes z to the axis; half a turn about x where they are opposite.
Eigen::Isometry3d turn_to_axis(const Eigen::Vector3d& axis) {
  if (axis.head<2>().norm() < kDrawnRounding)
    return axis.z() > 0.0 ? Eigen::Isometry3d::Identity() : turned(std::numbers::pi, Eigen::Vector3d::UnitX());
  return Eigen::Isometry3d(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis));
}

/// An angle by half turns within a quarter turn of 0, and whether one was taken off.
bool take_half_turn(double& angle_rad) {
  constexpr double kSlack = 1e-9;
  if (std::abs(angle_rad) <= std::numbers::pi / 2.0 + kSlack) return false;
  angle_rad += angle_rad > 0.0 ? -std::numbers::pi : std::numbers::pi;
  return true;
}

/// Makes rows of axes, from the base on.
class RowMaker {
 public:
  explicit RowMaker(const Eigen::Isometry3d& first) : place_(first) {}

  /// Ends the last row where the line through `point_m` along `direction` (base frame) says that it must, and begins
  /// the next one on it.
  void lead_to(Joint& last, Joint& next, const Eigen::Vector3d& point_m, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d point = place_.inverse() * point_m;
    const Eigen::Vector3d axis = place_.linear().transpose() * direction;
    if (std::hypot(axis.x(), axis.y()) < kNearParallel) {
      by_plane(last, next, point, axis);
    } else {
      by_normal(last, next, point, axis);
    }
    for (double* value : {&last.theta_rad, &last.d_m, &next.a_m, &next.alpha_rad, &next.beta_rad})
      *value = without_rounding(*value);
    end(last);
    place_ = links.back() * turned(next.alpha_rad, Eigen::Vector3d::UnitX()) *
             Eigen::Translation3d(next.a_m, 0.0, 0.0) * turned(next.beta_rad, Eigen::Vector3d::UnitY());
  }

  /// Ends the last row at a frame (base frame) whose z is its axis.
  void lead_to_frame(Joint& last, const Eigen::Isometry3d& frame) {
    const Eigen::Isometry3d seen = place_.inverse() * frame;
    last.theta_rad = without_rounding(std::atan2(seen.linear()(1, 0), seen.linear()(0, 0)));
    last.d_m = without_rounding(seen.translation().z());
    end(last);
  }

  std::vector<Eigen::Isometry3d> links;  ///< base frame, all joints at 0

 private:
  /// By the common normal of z and the line.
  static void by_normal(Joint& last, Joint& next, const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
    double sine = std::hypot(axis.x(), axis.y());
    last.theta_rad = std::atan2(axis.x(), -axis.y());
    if (take_half_turn(last.theta_rad)) sine = -sine;
    const Eigen::Vector3d x(std::cos(last.theta_rad), std::sin(last.theta_rad), 0.0), y(-x.y(), x.x(), 0.0);
    last.d_m = point.z() + point.dot(y) / sine * axis.z();
    next.a_m = point.dot(x);
    next.alpha_rad = std::atan2(sine, axis.z());
    next.beta_rad = 0.0;
  }

  /// By where the line meets the plane across z at the drawn point.
  static void by_plane(Joint& last, Joint& next, const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
    last.d_m = point.z();
    next.a_m = std::hypot(point.x(), point.y());
    last.theta_rad = next.a_m < kDrawnRounding ? 0.0 : std::atan2(point.y(), point.x());
    if (take_half_turn(last.theta_rad)) next.a_m = -next.a_m;
    const Eigen::Vector3d seen = Eigen::AngleAxisd(-last.theta_rad, Eigen::Vector3d::UnitZ()) * axis;
    next.beta_rad = std::asin(std::clamp(seen.x(), -1.0, 1.0));
    next.alpha_rad = std::atan2(-seen.y(), seen.z());
  }

  void end(const Joint& last) {
    links.push_back(place_ * turned(last.theta_rad, Eigen::Vector3d::UnitZ()) *
                    Eigen::Translation3d(0.0, 0.0, last.d_m));
  }

  Eigen::Isometry3d place_;  ///< z is the axis of the joint whose row is being made
};

EquivalentChain chain_by_axes(const DrawnArm& arm) {
  std::vector<Eigen::Isometry3d> drawn;  // base frame, all commands at 0
  std::vector<Eigen::Vector3d> axes;
  Eigen::Isometry3d frame = pose_of(arm.base);
  for (const DrawnJoint& joint : arm.joints) {
    frame = frame * pose_of(joint.origin) * motion(joint, joint.offset);
    drawn.push_back(frame);
    axes.emplace_back(joint.direction * joint.axis.normalized());
  }
  EquivalentChain result{{.convention = Convention::modified_dh, .joints = {}}, {}};
  std::vector<Joint>& rows = result.chain.joints;
  for (const DrawnJoint& joint : arm.joints) {
    rows.push_back({.type = joint.row.type,
                    .lower = joint.row.lower,
                    .upper = joint.row.upper,
                    .endless = joint.row.endless,
                    .gear = joint.row.gear});
  }
  result.chain.base = drawn.front() * turn_to_axis(axes.front());
  RowMaker maker(result.chain.base);
  for (std::size_t i = 1; i < rows.size(); ++i)
    maker.lead_to(rows[i - 1], rows[i], drawn[i].translation(), drawn[i].linear() * axes[i]);
  maker.lead_to_frame(rows.back(), drawn.back() * turn_to_axis(axes.back()));
  for (std::size_t i = 0; i < rows.size(); ++i) result.drawn_links.push_back(maker.links[i].inverse() * drawn[i]);
  result.chain.flange = result.drawn_links.back() * pose_of(arm.flange);
  return result;
}

double half_turned(double angle_rad) {
  return angle_rad > 0.0 ? angle_rad - std::numbers::pi : angle_rad + std::numbers::pi;
}

/// Turns the axis of a row about x by half a turn: the joint then counts the other way. `half` is such a turn.
void reverse(EquivalentChain& arm, std::size_t joint, const Eigen::Isometry3d& half) {
  std::vector<Joint>& rows = arm.chain.joints;
  Joint& row = rows[joint];
  const bool standard = arm.chain.convention == Convention::standard_dh;
  row.theta_rad = -row.theta_rad;
  row.d_m = -row.d_m;
  row.alpha_rad = half_turned(row.alpha_rad);
  if (standard) {  // the link before ends with the half turn; the own one takes it back behind its Rx
    if (joint == 0) {
      arm.chain.base = arm.chain.base * half;
    } else {
      rows[joint - 1].alpha_rad = half_turned(rows[joint - 1].alpha_rad);
      rows[joint - 1].beta_rad = -rows[joint - 1].beta_rad;
      arm.drawn_links[joint - 1] = half * arm.drawn_links[joint - 1];
    }
  } else {  // the own link ends with it, and the next takes it back
    row.beta_rad = -row.beta_rad;
    arm.drawn_links[joint] = half * arm.drawn_links[joint];
    if (joint + 1 < rows.size()) {
      rows[joint + 1].alpha_rad = half_turned(rows[joint + 1].alpha_rad);
    } else {
      arm.chain.flange = half * arm.chain.flange;
    }
  }
}

EquivalentChain chain_by_rows(const DrawnArm& arm) {
  EquivalentChain result{{.convention = arm.convention, .joints = {}}, {}};
  result.chain.base = pose_of(arm.base);
  result.chain.flange = pose_of(arm.flange);
  for (const DrawnJoint& joint : arm.joints) {
    Joint row = joint.row;
    (is_revolute(row) ? row.theta_rad : row.d_m) += joint.offset;
    result.chain.joints.push_back(row);
    result.drawn_links.push_back(Eigen::Isometry3d::Identity());
  }
  Eigen::Isometry3d half = Eigen::Isometry3d::Identity();
  half.linear().diagonal() << 1.0, -1.0, -1.0;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    if (arm.joints[i].direction < 0) reverse(result, i, half);
  }
  return result;
}

/// Every angle by whole turns near the other.
Eigen::Vector3d wrapped_near(const Eigen::Vector3d& angles_rad, const Eigen::Vector3d& near_rad) {
  Eigen::Vector3d wrapped;
  for (int i = 0; i < 3; ++i) wrapped[i] = wrap_near(angles_rad[i], near_rad[i]);
  return wrapped;
}

}  // namespace

Eigen::Isometry3d pose_of(const Origin& origin) {
  return Eigen::Translation3d(origin.xyz_m) * turned(origin.rpy_rad.z(), Eigen::Vector3d::UnitZ()) *
         turned(origin.rpy_rad.y(), Eigen::Vector3d::UnitY()) * turned(origin.rpy_rad.x(), Eigen::Vector3d::UnitX());
}

Origin origin_of(const Eigen::Isometry3d& pose, const Origin& near) {
  constexpr double kUpright = 1e-15;  // cosine of the pitch below which there is no yaw in it
  const Eigen::Matrix3d& r = pose.linear();
  const double cosine = std::hypot(r(0, 0), r(1, 0));
  const double pitch = std::atan2(-r(2, 0), cosine);
  const double yaw = cosine > kUpright ? std::atan2(r(1, 0), r(0, 0)) : near.rpy_rad.z();
  // By the yaw as it was rounded: then the two make up the same turn where they are about nearly the same axis.
  const double c = std::cos(yaw), s = std::sin(yaw);
  const double roll = std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1));
  const Eigen::Vector3d one(roll, pitch, yaw);
  const Eigen::Vector3d other(roll + std::numbers::pi, std::numbers::pi - pitch, yaw + std::numbers::pi);
  const Eigen::Vector3d one_near = wrapped_near(one, near.rpy_rad), other_near = wrapped_near(other, near.rpy_rad);
  const bool first = (one_near - near.rpy_rad).norm() <= (other_near - near.rpy_rad).norm();
  return {pose.translation(), first ? one_near : other_near};
}

DrawnArm behind_positioner(const DrawnArm& arm, const std::vector<DrawnJoint>& positioner, const Origin& workpiece) {
  DEMECAL_CHECK(arm.by_axes && !arm.joints.empty() && !positioner.empty(), positioner.size() << " axes");
  DrawnArm seen = arm;
  seen.positioner = DrawnPositioner{positioner, workpiece, arm.base, arm.joints.front().origin};
  seen.base = {};
  seen.joints.clear();
  Eigen::Isometry3d before = pose_of(workpiece).inverse();  // of the next joint's frame in the one before
  for (auto joint = positioner.rbegin(); joint != positioner.rend(); ++joint) {
    seen.joints.push_back(*joint);
    seen.joints.back().origin = origin_of(before);
    seen.joints.back().axis = -joint->axis;
    before = pose_of(joint->origin).inverse();
  }
  seen.joints.insert(seen.joints.end(), arm.joints.begin(), arm.joints.end());
  Origin& first = seen.joints[positioner.size()].origin;
  first = origin_of(before * pose_of(arm.base) * pose_of(first));
  return seen;
}

EquivalentChain equivalent_chain(const DrawnArm& arm) {
  DEMECAL_CHECK(!arm.joints.empty() && arm.joints.size() <= static_cast<std::size_t>(kMaxJoints), arm.joints.size());
  EquivalentChain result = arm.by_axes ? chain_by_axes(arm) : chain_by_rows(arm);
  result.chain.couplings = arm.couplings;
  if (arm.positioner) result.chain.positioner = static_cast<int>(arm.positioner->joints.size());
  return result;
}

std::vector<Origin> origins_of(const DrawnArm& arm, const Chain& chain) {
  DEMECAL_CHECK(arm.by_axes && arm.joints.size() == chain.joints.size(), arm.joints.size() << " joints");
  const std::vector<Eigen::Isometry3d> drawn_links = equivalent_chain(arm).drawn_links;
  std::vector<Origin> origins;
  Eigen::Isometry3d before = pose_of(arm.base).inverse() * chain.base;  // of the link before, as it was drawn
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    Eigen::Isometry3d row = Eigen::Isometry3d::Identity();
    for (const Elementary& transform : elementary_transforms(chain.convention))
      advance(row, transform, chain.joints[i].parameter(transform.parameter));
    const DrawnJoint& joint = arm.joints[i];
    const Eigen::Isometry3d origin = before * row * drawn_links[i] * motion(joint, joint.offset).inverse();
    origins.push_back(origin_of(origin, joint.origin));
    before = drawn_links[i].inverse();
  }
  return origins;
}

}  // namespace demecal::inline kinematics
