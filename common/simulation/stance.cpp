#include "simulation/stance.hpp"

#include <array>
#include <cstddef>
#include <iterator>

#include "errors/check.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline simulation {
namespace {

/// Whether the transform `parameter` is the first along or about the joint's axis: Rz in either convention.
bool opens_axis(LinkParameter parameter) {
  return parameter == LinkParameter::theta;
}

struct Weight {
  Eigen::Vector3d at_m;     ///< base frame
  Eigen::Vector3d force_n;  ///< base frame
};

/// One per link, then the payload.
std::vector<Weight> weights(const Robot& robot, const Stance& stance, double payload_kg) {
  std::vector<Weight> all;
  for (std::size_t i = 0; i < stance.links.size(); ++i) {
    const LinkMass link = robot.masses.empty() ? LinkMass{} : robot.masses[i];
    all.push_back({stance.links[i] * link.centre_m, link.mass_kg * robot.gravity_mps2});
  }
  all.push_back({stance.flange * robot.chain.tool_m, payload_kg * robot.gravity_mps2});
  return all;
}

}  // namespace

Eigen::Quaterniond rotation_by(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector_rad / angle));
}

Stance stand(const Chain& chain, const JointVector& q, std::span<const Eigen::Vector3d> tilts) {
  DEMECAL_CHECK(q.size() == chain.size(), q.size() << " joint values for " << chain.size() << " joints");
  DEMECAL_CHECK(tilts.empty() || std::ssize(tilts) == chain.size(), tilts.size() << " tilts");
  Stance stance;
  Eigen::Isometry3d frame = chain.base;
  const JointVector driven = driven_joints(chain, q);
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const Joint& joint = chain.joints[i];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      if (opens_axis(transform.parameter)) {
        if (!tilts.empty()) frame.rotate(rotation_by(tilts[i]));
        stance.axes.push_back(frame);
      }
      const bool moves = transform.parameter == moving_parameter(joint);
      const double variable = moves ? driven[static_cast<Eigen::Index>(i)] : 0.0;
      advance(frame, transform, joint.parameter(transform.parameter) + variable);
    }
    stance.links.push_back(frame);
  }
  stance.flange = frame * chain.flange;
  return stance;
}

std::vector<JointLoad> gravity_loads(const Robot& robot, const JointVector& q, double payload_kg) {
  const std::size_t n = robot.chain.joints.size();
  DEMECAL_CHECK(robot.masses.empty() || robot.masses.size() == n, robot.masses.size() << " masses, " << n << " links");
  const Stance stance = stand(robot.chain, q);
  const std::vector<Weight> all = weights(robot, stance, payload_kg);
  std::vector<JointLoad> loads(n);
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (std::size_t carried = i; carried < all.size(); ++carried) {
      force += all[carried].force_n;
      moment += (all[carried].at_m - stance.axes[i].translation()).cross(all[carried].force_n);
    }
    loads[i].force_n = stance.axes[i].linear().transpose() * force;
    loads[i].moment_nm = stance.axes[i].linear().transpose() * moment;
    const bool revolute = is_revolute(robot.chain.joints[i]);
    loads[i].effort = revolute ? loads[i].moment_nm.z() : loads[i].force_n.z();
  }
  return loads;
}

}  // namespace demecal::inline simulation
