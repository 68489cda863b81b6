#include "formulas/symbolic_state.hpp"

#include "effects/joint_words.hpp"

namespace demecal {
namespace {

/// Mass, and its moment about the base's origin, of the links from a joint on.
struct Beyond {
  double mass_kg = 0.0;
  SymbolicVector moment_kg_m;
};

Beyond beyond(const SymbolicState& state, int joint) {
  Algebra& algebra = state.algebra();
  Beyond all{0.0, constant_vector(algebra, Eigen::Vector3d::Zero())};
  for (std::size_t i = static_cast<std::size_t>(joint); i < state.robot->masses.size(); ++i) {
    const LinkMass& link = state.robot->masses[i];
    all.mass_kg += link.mass_kg;
    const SymbolicVector centre = state.links[i].point(constant_vector(algebra, link.centre_m));
    all.moment_kg_m = plus(all.moment_kg_m, scaled(algebra.constant(link.mass_kg), centre));
  }
  return all;
}

const SymbolicFrame& place(const SymbolicState& state, int joint) {
  return state.places[static_cast<std::size_t>(joint)];
}

/// Nm, base frame.
SymbolicVector moment(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2) {
  Algebra& algebra = state.algebra();
  const Beyond all = beyond(state, joint);
  const SymbolicVector arm = minus(all.moment_kg_m, scaled(algebra.constant(all.mass_kg), place(state, joint).origin));
  return cross(arm, constant_vector(algebra, gravity_mps2));
}

}  // namespace

SymbolicState symbolic_state(Algebra& algebra, const Robot& robot, const std::vector<Expression>& joints) {
  SymbolicState state{&robot, joints, {}, {}, constant_vector(algebra, Eigen::Vector3d::Zero())};
  SymbolicFrame frame(algebra);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& link = robot.chain.joints[i];
    const LinkParameter variable = link.type == JointType::revolute ? LinkParameter::theta : LinkParameter::d;
    for (const Elementary& transform : elementary_transforms(robot.chain.convention)) {
      if (transform.parameter == LinkParameter::theta) state.places.push_back(frame);
      const Expression fixed = algebra.constant(link.parameter(transform.parameter));
      advance(frame, transform, transform.parameter == variable ? joints[i] + fixed : fixed);
    }
    state.links.push_back(frame);
  }
  state.places.push_back(frame);
  return state;
}

Expression effort(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2) {
  const SymbolicVector& axis = place(state, joint).axes[2];
  if (is_revolute(*state.robot, joint)) return dot(axis, moment(state, joint, gravity_mps2));
  return beyond(state, joint).mass_kg * dot(axis, constant_vector(state.algebra(), gravity_mps2));
}

SymbolicVector gravity_moment(const SymbolicState& state, int joint) {
  return place(state, joint).own_direction(moment(state, joint, state.robot->gravity_mps2));
}

Expression lever(const SymbolicState& state, int joint, const WeightPart& part, const Eigen::Vector3d& gravity_mps2) {
  Algebra& algebra = state.algebra();
  const double strength = gravity_mps2.norm();
  if (strength == 0.0) return algebra.constant(0.0);
  const SymbolicVector down = constant_vector(algebra, gravity_mps2 / strength);
  const SymbolicVector& axis = place(state, joint).axes[2];
  const SymbolicFrame& link = state.links[static_cast<std::size_t>(part.link)];
  const bool mass = part.axis == 3;
  if (!is_revolute(*state.robot, joint)) return mass ? dot(axis, down) : algebra.constant(0.0);
  const SymbolicVector arm =
      mass ? minus(link.origin, place(state, joint).origin) : link.axes[static_cast<std::size_t>(part.axis)];
  return dot(axis, cross(arm, down));
}

}  // namespace demecal
