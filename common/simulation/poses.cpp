#include "simulation/simulated_robot.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"
#include "simulation/stance.hpp"

namespace demecal::inline simulation {
namespace {

constexpr int kTargets = 400;         ///< tool poses tried until one can be reached
constexpr int kStarts = 4;            ///< starts of the inverse kinematics for each
constexpr int kJointDraws = 40000;    ///< joint vectors tried until one brings the tool point into the cuboid
constexpr double kStartSpread = 0.4;  ///< rad or m about home
/// Below this a small motion of the tool takes large ones of the joints, and offline programs avoid the place.
constexpr double kNearSingular = 0.08;
constexpr double kBoxTolerance_m = 1e-9;

using JointRange = std::array<double, 2>;

std::vector<JointRange> limits(const Chain& chain) {
  std::vector<JointRange> ranges;
  for (const Joint& joint : chain.joints) ranges.push_back({joint.lower, joint.upper});
  return ranges;
}

JointVector random_joints(const std::vector<JointRange>& ranges, RandomStream& random) {
  JointVector q(static_cast<Eigen::Index>(ranges.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointRange& range = ranges[static_cast<std::size_t>(i)];
    q[i] = random.real(range[0], range[1]);
  }
  return q;
}

Eigen::Vector3d random_vector(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, RandomStream& random) {
  Eigen::Vector3d vector;
  for (int axis = 0; axis < 3; ++axis) vector[axis] = random.real(lower[axis], upper[axis]);
  return vector;
}

/// The same stance with every revolute joint turned to within half a turn of home, and on by a whole turn where only
/// that meets its limits; nothing where no turn does.
std::optional<JointVector> turned_into_limits(const Chain& chain, JointVector q, const JointVector& home) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    if (is_revolute(joint)) {
      q[i] = wrap_near(q[i], home[i]);
      if (q[i] < joint.lower || q[i] > joint.upper) q[i] = wrap_near(q[i], 0.5 * (joint.lower + joint.upper));
    }
    if (q[i] < joint.lower || q[i] > joint.upper) return std::nullopt;
  }
  return q;
}

/// No tool point of the arm is farther from the base than this, m.
double farthest_reach(const Chain& chain) {
  double reach = chain.tool_m.norm();
  for (const Joint& joint : chain.joints) {
    const bool slides = !is_revolute(joint);
    const double slide = slides ? std::max(std::abs(joint.lower), std::abs(joint.upper)) : 0.0;
    reach += std::hypot(joint.a_m, std::abs(joint.d_m) + slide);
  }
  return reach;
}

JointVector random_start(const Scenario& scenario, RandomStream& random) {
  JointVector start = scenario.home;
  for (double& value : start) value += random.real(-kStartSpread, kStartSpread);
  return start;
}

/// Joints that bring the tool to `target`, tried from home and then from random joints about it.
std::optional<JointVector> reach(const Scenario& scenario, const Eigen::Isometry3d& target, RandomStream& random) {
  const Chain& chain = scenario.robot.chain;
  if (target.translation().norm() > farthest_reach(chain)) return std::nullopt;
  const PoseFunction tool_pose = [&chain](const JointVector& q) {
    Eigen::Isometry3d pose = forward(chain, q);
    pose.translate(chain.tool_m);
    return PoseAndJacobian{pose, joint_jacobian(chain, q, chain.tool_m)};
  };
  for (int attempt = 0; attempt < kStarts; ++attempt) {
    const JointVector start = attempt == 0 ? scenario.home : random_start(scenario, random);
    const InverseSolution found = inverse(tool_pose, target, start);
    if (found.status != InverseStatus::converged) continue;
    const std::optional<JointVector> joints = turned_into_limits(chain, found.q, scenario.home);
    // Asked again where it stands, the solver tells how near to singular that is.
    if (joints && inverse(tool_pose, target, *joints).smallest_singular >= kNearSingular) return joints;
  }
  return std::nullopt;
}

std::string box_text(const Scenario& scenario) {
  std::string text;
  for (const Eigen::Vector3d& vector : {scenario.box_corner_m, scenario.box_size_m}) {
    text += text.empty() ? "corner" : ", size";
    for (const double value : vector) text.append(1, ' ').append(number_text(value, millimetres, metres));
  }
  return text + " mm";
}

JointVector pose_in_box(const Scenario& scenario, RandomStream& random) {
  const Eigen::Matrix3d upright = forward(scenario.robot.chain, scenario.home).linear();
  const Eigen::Vector3d spread = Eigen::Vector3d::Constant(scenario.orientation_spread_rad);
  for (int attempt = 0; attempt < kTargets; ++attempt) {
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.translation() = random_vector(scenario.box_corner_m, scenario.box_corner_m + scenario.box_size_m, random);
    target.linear() = upright * rotation_by(random_vector(-spread, spread, random)).toRotationMatrix();
    if (const std::optional<JointVector> joints = reach(scenario, target, random)) return *joints;
  }
  throw InputError({}, box_text(scenario),
                   "none of " + std::to_string(kTargets) +
                       " random tool poses in the cuboid could be reached within the joint limits, with the "
                       "orientation of home tilted by up to the orientation spread; move the cuboid or choose "
                       "another home");
}

JointVector joints_into_box(const Scenario& scenario, RandomStream& random) {
  const Eigen::Array3d lower = scenario.box_corner_m.array() - kBoxTolerance_m;
  const Eigen::Array3d upper = (scenario.box_corner_m + scenario.box_size_m).array() + kBoxTolerance_m;
  const std::vector<JointRange> ranges = limits(scenario.robot.chain);
  for (int attempt = 0; attempt < kJointDraws; ++attempt) {
    const JointVector q = random_joints(ranges, random);
    const Eigen::Array3d point = tool_position(scenario.robot.chain, q).array();
    if ((point >= lower).all() && (point <= upper).all()) return q;
  }
  throw InputError({}, box_text(scenario),
                   "none of " + std::to_string(kJointDraws) +
                       " random joint values within the limits brings the tool point into the cuboid");
}

}  // namespace

std::vector<JointVector> draw_poses(const Scenario& scenario, int count, RandomStream& random) {
  const Chain& chain = scenario.robot.chain;
  const std::vector<JointRange> ranges = scenario.joint_ranges.empty() ? limits(chain) : scenario.joint_ranges;
  std::vector<JointVector> poses;
  for (int pose = 0; pose < count; ++pose) {
    poses.push_back(scenario.by_joints ? random_joints(ranges, random)
                    : chain.size() < 6 ? joints_into_box(scenario, random)
                                       : pose_in_box(scenario, random));
  }
  return poses;
}

}  // namespace demecal::inline simulation
