#include "programs/nominal_joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/joint_kinematics.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kNear = 1.0;  ///< rad or m: a solution this near to the last one is taken without looking further
constexpr double kSignRounding = 1e-6;  ///< rad, of signs and quadrants

bool limited(const Joint& joint) {
  return !joint.endless && joint.lower < joint.upper;
}

/// About where the hint has the joint; elsewhere, where the reference has it.
double hinted(const ArmHint& hint, std::size_t joint, double reference) {
  if (joint < hint.quadrants.size() && hint.quadrants[joint])
    return (*hint.quadrants[joint] + 0.5) * std::numbers::pi / 2.0;
  if (joint < hint.negative.size() && hint.negative[joint])
    return *hint.negative[joint] ? -std::numbers::pi / 2.0 : std::numbers::pi / 2.0;
  return reference;
}

struct JointSolution {
  JointVector q;
  int contradicting = 0;
  bool outside = false;
  double distance = 0.0;
};

JointSolution candidate(const Chain& arm, JointVector q, const ArmHint& hint, const JointVector& reference) {
  JointSolution made;
  q = in_hinted_turns(arm, q, hint, reference);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    made.outside = made.outside || beyond_limits(arm.joints[static_cast<std::size_t>(i)], q[i]) > 0.0;
    made.distance = std::max(made.distance, std::abs(q[i] - reference[i]));
  }
  made.contradicting = contradictions(hint, q);
  made.q = q;
  return made;
}

bool better(const JointSolution& one, const JointSolution& other) {
  if (one.outside != other.outside) return other.outside;
  if (one.contradicting != other.contradicting) return one.contradicting < other.contradicting;
  return one.distance < other.distance - 1e-6;
}

}  // namespace

PoseFunction nominal_pose(const Chain& arm) {
  return [turns = FixedTurns(arm)](const JointVector& q) {
    const Eigen::Vector3d& tool_m = turns.chain().tool_m;
    const JointKinematics at = joint_kinematics(turns, q, tool_m);
    return PoseAndJacobian{at.flange * Eigen::Translation3d(tool_m), at.joints};
  };
}

JointVector search_start(const Chain& arm, int index, const JointVector& reference, int held) {
  JointVector start(arm.size());
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const Joint& joint = arm.joints[static_cast<std::size_t>(i)];
    double lower = -std::numbers::pi, upper = std::numbers::pi;
    if (!is_revolute(joint) || (limited(joint) && joint.upper - joint.lower < 2.0 * std::numbers::pi)) {
      lower = joint.lower;
      upper = joint.upper;
    }
    start[i] = lower + (upper - lower) * spread_share(index, static_cast<std::size_t>(i));
  }
  start.head(held) = reference.head(held);
  return start;
}

double nearest_turn(const Joint& joint, double value, double reference) {
  if (!is_revolute(joint)) return value;
  const double near = wrap_near(value, reference);
  double best = near;
  for (const double turned : {near - 2.0 * std::numbers::pi, near + 2.0 * std::numbers::pi}) {
    const double better = beyond_limits(joint, best) - beyond_limits(joint, turned);
    if (better > 0.0) best = turned;
  }
  return best;
}

JointVector in_hinted_turns(const Chain& arm, JointVector joints, const ArmHint& hint, const JointVector& reference) {
  for (Eigen::Index i = 0; i < joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(i);
    joints[i] = nearest_turn(arm.joints[joint], joints[i], hinted(hint, joint, reference[i]));
  }
  return joints;
}

double beyond_limits(const Joint& joint, double value) {
  if (!limited(joint)) return 0.0;
  return std::max({0.0, joint.lower - value, value - joint.upper});
}

int contradictions(const ArmHint& hint, const JointVector& joints) {
  int count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(joints.size()); ++i) {
    const double angle = joints[static_cast<Eigen::Index>(i)];
    if (i < hint.negative.size() && hint.negative[i]) {
      count += (*hint.negative[i] ? angle > kSignRounding : angle < -kSignRounding) ? 1 : 0;
    }
    if (i < hint.quadrants.size() && hint.quadrants[i]) {
      const double lower = *hint.quadrants[i] * std::numbers::pi / 2.0;
      count += angle < lower - kSignRounding || angle > lower + std::numbers::pi / 2.0 + kSignRounding ? 1 : 0;
    }
  }
  return count;
}

std::optional<JointVector> nominal_joints(const Chain& arm, const Eigen::Isometry3d& tool, const ArmHint& hint,
                                          const JointVector& reference, int held) {
  const PoseFunction model = nominal_pose(arm);
  const JointVector& near = hint.near.size() == arm.size() ? hint.near : reference;
  std::optional<JointSolution> best;
  for (int index = 0; index <= kSearchStarts; ++index) {
    const InverseSolution solution =
        inverse(model, tool, index == 0 ? near : search_start(arm, index, near, held), {.held = held});
    if (solution.status != InverseStatus::converged) continue;
    JointSolution found = candidate(arm, solution.q, hint, near);
    if (!best || better(found, *best)) best = std::move(found);
    if (best->contradicting == 0 && !best->outside && best->distance < kNear) break;
  }
  if (!best) return std::nullopt;
  return best->q;
}

std::optional<JointVector> joints_at_point(const Chain& arm, const Eigen::Vector3d& point_m,
                                           const JointVector& reference) {
  const FixedTurns turns(arm);
  const PoseFunction model = [&](const JointVector& q) {
    const JointKinematics tool = joint_kinematics(turns, q, arm.tool_m);
    PoseAndJacobian at{Eigen::Isometry3d(Eigen::Translation3d(tool.flange * arm.tool_m)), tool.joints};
    at.jacobian.bottomRows<3>().setZero();
    return at;
  };
  const Eigen::Isometry3d target{Eigen::Translation3d(point_m)};
  for (int index = 0; index <= kSearchStarts; ++index) {
    const InverseSolution solution =
        inverse(model, target, index == 0 ? reference : search_start(arm, index, reference, 0));
    if (solution.status != InverseStatus::converged) continue;
    const JointSolution found = candidate(arm, solution.q, {}, reference);
    if (!found.outside) return found.q;
  }
  return std::nullopt;
}

}  // namespace demecal::inline programs
