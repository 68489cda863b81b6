#include "simulation/statics.hpp"

#include "errors/check.hpp"
#include "simulation/stance.hpp"

namespace demecal {
namespace {

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
  all.push_back({stance.links.back() * robot.chain.tool_m, payload_kg * robot.gravity_mps2});
  return all;
}

}  // namespace

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
    const bool revolute = robot.chain.joints[i].type == JointType::revolute;
    loads[i].effort = revolute ? loads[i].moment_nm.z() : loads[i].force_n.z();
  }
  return loads;
}

}  // namespace demecal
