#include "effects/arm_state.hpp"

#include <array>
#include <cstddef>
#include <iterator>

#include "errors/check.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {
namespace {

/// Sets places and links: the frames met on the way from base to flange.
void set_frames(const Chain& chain, ArmState& state) {
  Eigen::Isometry3d frame = chain.base;
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      // In either convention the axis of the joint is that of its first transform about z.
      if (transform.parameter == LinkParameter::theta) state.places.push_back(frame);
      advance(frame, transform, elementary_value(joint, transform.parameter, state.driven[i]));
    }
    state.links.push_back(frame);
  }
  state.places.push_back(frame * chain.flange);
}

/// Sets loads, from the payload inwards: a place bears what the next one bears, and its own link.
void set_loads(const Robot& robot, ArmState& state) {
  const std::size_t n = state.links.size();
  double mass_kg = state.stop.payload_kg;
  Eigen::Vector3d moment_kg_m = mass_kg * state.payload_point_m;  // of mass, about the base's origin
  state.loads.resize(n);
  for (std::size_t i = n; i-- > 0;) {
    if (!robot.masses.empty()) {
      const LinkMass& link = robot.masses[i];
      mass_kg += link.mass_kg;
      moment_kg_m += link.mass_kg * (state.links[i] * link.centre_m);
    }
    const Eigen::Isometry3d& place = state.places[i];
    const Eigen::Vector3d lever_kg_m = moment_kg_m - mass_kg * place.translation();
    state.loads[i].force_n = place.linear().transpose() * (mass_kg * state.gravity_mps2);
    state.loads[i].moment_nm = place.linear().transpose() * lever_kg_m.cross(state.gravity_mps2);
  }
}

}  // namespace

Stop::Stop(const MeasuredPose& pose)
    : joints(pose.joints),
      approach(pose.approach.value_or(ApproachSigns{})),
      torque(pose.torque.value_or(JointVector{})),
      payload_kg(pose.payload_kg.value_or(0.0)),
      payload_stated(pose.payload_kg.has_value()),
      temperature_celsius(pose.temperature_celsius),
      time_s(pose.time_s) {}

Stop Stop::with_joints(const JointVector& commanded) const {
  Stop stop = *this;
  stop.joints = commanded;
  return stop;
}

double ArmState::torque(const Chain& chain, int joint) const {
  const auto i = static_cast<std::size_t>(joint);
  return is_revolute(chain.joints[i]) ? loads[i].moment_nm.z() : loads[i].force_n.z();
}

ArmState arm_state(const Robot& robot, const Stop& stop) {
  DEMECAL_CHECK(stop.joints.size() == robot.chain.size(), stop.joints.size() << " of " << robot.chain.size());
  DEMECAL_CHECK(robot.masses.empty() || std::ssize(robot.masses) == robot.chain.size(), robot.masses.size());
  ArmState state{.stop = stop,
                 .driven = driven_joints(robot.chain, stop.joints),
                 .places = {},
                 .links = {},
                 .loads = {},
                 .gravity_mps2 = robot.gravity_mps2,
                 .payload_point_m = robot.chain.tool_m,
                 .tool_in_sensor_m = Eigen::Vector3d::Zero()};
  set_frames(robot.chain, state);
  state.payload_point_m = state.places.back() * robot.chain.tool_m;
  set_loads(robot, state);
  return state;
}

}  // namespace demecal::inline effects
