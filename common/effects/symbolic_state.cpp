#include "effects/symbolic_state.hpp"

#include <algorithm>
#include <cstddef>

namespace demecal::inline effects {
namespace {

/// Turns the frame about one of its own axes: the two that follow it mix.
void turn_frame(SymbolicFrame& frame, int axis, Expression angle) {
  const auto first = static_cast<std::size_t>((axis + 1) % 3), second = static_cast<std::size_t>((axis + 2) % 3);
  const Expression c = cosine(angle), s = sine(angle);
  const SymbolicVector old_first = frame.axes[first], old_second = frame.axes[second];
  frame.axes[first] = plus(scaled(c, old_first), scaled(s, old_second));
  frame.axes[second] = minus(scaled(c, old_second), scaled(s, old_first));
}

/// The rotation by a vector (Rodrigues): 1 + sin t / t [v] + (1 - cos t) / t^2 [v]^2, t = |v|, whole at t = 0 too.
SymbolicFrame rotation(Algebra& algebra, const SymbolicVector& vector) {
  const Expression length = square_root(dot(vector, vector)), half = 0.5 * length;
  const Expression by_sine = algebra.function(Function::divide_or_one, {sine(length), length});
  const Expression by_half = algebra.function(Function::divide_or_one, {sine(half), half});
  const Expression by_cosine = 0.5 * by_half * by_half;
  SymbolicFrame result(algebra);
  for (SymbolicVector& axis : result.axes) {
    const SymbolicVector once = cross(vector, axis);
    axis = plus(axis, plus(scaled(by_sine, once), scaled(by_cosine, cross(vector, once))));
  }
  return result;
}

/// Mass, and its moment about the base's origin, of the payload and the links from a joint on.
struct Beyond {
  Expression mass_kg;
  SymbolicVector moment_kg_m;
};

Beyond masses_beyond(const SymbolicState& state, int joint) {
  Algebra& algebra = state.algebra();
  Beyond all{state.payload_kg(), scaled(state.payload_kg(), state.payload_point)};
  for (std::size_t i = static_cast<std::size_t>(joint); i < state.robot->masses.size(); ++i) {
    const LinkMass& link = state.robot->masses[i];
    all.mass_kg = all.mass_kg + link.mass_kg;
    const SymbolicVector centre = state.links[i].point(constant_vector(algebra, link.centre_m));
    all.moment_kg_m = plus(all.moment_kg_m, scaled(algebra.constant(link.mass_kg), centre));
  }
  return all;
}

const SymbolicFrame& joint_frame(const SymbolicState& state, int joint) {
  return state.places[static_cast<std::size_t>(joint)];
}

/// Nm, base frame.
SymbolicVector moment(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2) {
  Algebra& algebra = state.algebra();
  const Beyond all = masses_beyond(state, joint);
  const SymbolicVector arm = minus(all.moment_kg_m, scaled(all.mass_kg, joint_frame(state, joint).origin));
  return cross(arm, constant_vector(algebra, gravity_mps2));
}

/// The frame in which the link's transform `parameter` acts, from where the link begins.
SymbolicFrame symbolic_frame_before(const SymbolicWriter& writer, LinkParameter parameter) {
  const Chain& chain = writer.robot().chain;
  const auto joint = static_cast<std::size_t>(writer.effect.joint);
  SymbolicFrame frame(writer.state.algebra());
  for (const Elementary& transform : elementary_transforms(chain.convention)) {
    if (transform.parameter == parameter) break;
    advance(frame, transform, elementary_value(chain.joints[joint], transform.parameter, writer.state.driven[joint]));
  }
  return frame;
}

}  // namespace

SymbolicVector constant_vector(Algebra& algebra, const Eigen::Vector3d& vector) {
  return {algebra.constant(vector.x()), algebra.constant(vector.y()), algebra.constant(vector.z())};
}

SymbolicVector plus(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
SymbolicVector minus(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
SymbolicVector scaled(Expression factor, const SymbolicVector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Expression dot(const SymbolicVector& a, const SymbolicVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
SymbolicVector cross(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

SymbolicFrame::SymbolicFrame(Algebra& algebra) : SymbolicFrame(algebra, Eigen::Isometry3d::Identity()) {}

SymbolicFrame::SymbolicFrame(Algebra& algebra, const Eigen::Isometry3d& pose)
    : axes{constant_vector(algebra, pose.linear().col(0)), constant_vector(algebra, pose.linear().col(1)),
           constant_vector(algebra, pose.linear().col(2))},
      origin(constant_vector(algebra, pose.translation())) {}

SymbolicVector SymbolicFrame::direction(const SymbolicVector& own) const {
  return plus(plus(scaled(own[0], axes[0]), scaled(own[1], axes[1])), scaled(own[2], axes[2]));
}

SymbolicVector SymbolicFrame::point(const SymbolicVector& own) const {
  return plus(origin, direction(own));
}

SymbolicVector SymbolicFrame::own_direction(const SymbolicVector& outer) const {
  return {dot(axes[0], outer), dot(axes[1], outer), dot(axes[2], outer)};
}

SymbolicMatrix SymbolicFrame::matrix() const {
  SymbolicMatrix rows;
  for (std::size_t row = 0; row < 3; ++row) rows.push_back({axes[0][row], axes[1][row], axes[2][row], origin[row]});
  const Expression zero = algebra().constant(0.0);
  rows.push_back({zero, zero, zero, algebra().constant(1.0)});
  return rows;
}

SymbolicFrame operator*(const SymbolicFrame& frame, const SymbolicFrame& next) {
  SymbolicFrame result = frame;
  for (std::size_t i = 0; i < 3; ++i) result.axes[i] = frame.direction(next.axes[i]);
  result.origin = frame.point(next.origin);
  return result;
}

SymbolicFrame seen_from(const SymbolicFrame& from, const SymbolicFrame& frame) {
  SymbolicFrame result = frame;
  for (std::size_t i = 0; i < 3; ++i) result.axes[i] = from.own_direction(frame.axes[i]);
  result.origin = from.own_direction(minus(frame.origin, from.origin));
  return result;
}

std::vector<Expression> driven_joints(const Chain& chain, std::vector<Expression> commanded) {
  std::vector<Expression> driven = commanded;
  for (const auto& [joint, from, factor] : chain.couplings) {
    Expression& turned = driven[static_cast<std::size_t>(joint)];
    turned = turned + factor * commanded[static_cast<std::size_t>(from)];
  }
  return driven;
}

Expression elementary_value(const Joint& joint, LinkParameter parameter, Expression q) {
  const Expression fixed = q.algebra().constant(joint.parameter(parameter));
  return parameter == moving_parameter(joint) ? q + fixed : fixed;
}

void advance(SymbolicFrame& frame, const Elementary& transform, Expression value) {
  if (transform.rotates) return turn_frame(frame, transform.axis, value);
  frame.origin = plus(frame.origin, scaled(value, frame.axes[static_cast<std::size_t>(transform.axis)]));
}

SymbolicFrame moved(const SymbolicFrame& frame, const SymbolicMotion& motion) {
  SymbolicFrame result = frame;
  result.origin = frame.point({motion[0], motion[1], motion[2]});
  const SymbolicVector vector{motion[3], motion[4], motion[5]};
  const auto turns = std::ranges::count_if(vector, [](Expression component) { return !component.is(0.0); });
  if (turns == 1) {
    for (int axis = 0; axis < 3; ++axis) turn_frame(result, axis, vector[static_cast<std::size_t>(axis)]);
  } else if (turns > 1) {
    const SymbolicFrame by = rotation(frame.algebra(), vector);
    for (std::size_t i = 0; i < 3; ++i) result.axes[i] = frame.direction(by.axes[i]);
  }
  return result;
}

SymbolicState symbolic_state(Algebra& algebra, const Robot& robot, const std::vector<Expression>& joints) {
  SymbolicState state{&robot, joints, driven_joints(robot.chain, joints),
                      {},     {},     constant_vector(algebra, Eigen::Vector3d::Zero())};
  SymbolicFrame frame(algebra, robot.chain.base);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& link = robot.chain.joints[i];
    for (const Elementary& transform : elementary_transforms(robot.chain.convention)) {
      if (transform.parameter == LinkParameter::theta) state.places.push_back(frame);
      advance(frame, transform, elementary_value(link, transform.parameter, state.driven[i]));
    }
    state.links.push_back(frame);
  }
  state.places.push_back(frame * SymbolicFrame(algebra, robot.chain.flange));
  state.payload_point = state.places.back().point(constant_vector(algebra, robot.chain.tool_m));
  return state;
}

Expression effort(const SymbolicState& state, int joint, const Eigen::Vector3d& gravity_mps2) {
  const SymbolicVector& axis = joint_frame(state, joint).axes[2];
  if (is_revolute(state.robot->chain, joint)) return dot(axis, moment(state, joint, gravity_mps2));
  return masses_beyond(state, joint).mass_kg * dot(axis, constant_vector(state.algebra(), gravity_mps2));
}

Expression payload_torque(const SymbolicState& state, int joint) {
  const SymbolicVector weight_n =
      scaled(state.payload_kg(), constant_vector(state.algebra(), state.robot->gravity_mps2));
  const SymbolicFrame& place = joint_frame(state, joint);
  if (!is_revolute(state.robot->chain, joint)) return dot(place.axes[2], weight_n);
  return dot(place.axes[2], cross(minus(state.payload_point, place.origin), weight_n));
}

SymbolicVector gravity_moment(const SymbolicState& state, int joint) {
  return joint_frame(state, joint).own_direction(moment(state, joint, state.robot->gravity_mps2));
}

SymbolicVector lever_moment(const SymbolicState& state, int joint, const WeightPart& part) {
  const Eigen::Vector3d& gravity_mps2 = state.robot->gravity_mps2;
  const double strength = gravity_mps2.norm();
  if (strength == 0.0) return constant_vector(state.algebra(), Eigen::Vector3d::Zero());
  const SymbolicFrame& link = state.links[static_cast<std::size_t>(part.link)];
  const SymbolicVector arm = part.axis == 3 ? minus(link.origin, joint_frame(state, joint).origin)
                                            : link.axes[static_cast<std::size_t>(part.axis)];
  return joint_frame(state, joint).own_direction(cross(arm, constant_vector(state.algebra(), gravity_mps2 / strength)));
}

Expression lever(const SymbolicState& state, int joint, const WeightPart& part, const Eigen::Vector3d& gravity_mps2) {
  Algebra& algebra = state.algebra();
  const double strength = gravity_mps2.norm();
  if (strength == 0.0) return algebra.constant(0.0);
  const SymbolicVector down = constant_vector(algebra, gravity_mps2 / strength);
  const SymbolicVector& axis = joint_frame(state, joint).axes[2];
  const SymbolicFrame& link = state.links[static_cast<std::size_t>(part.link)];
  const bool mass = part.axis == 3;
  if (!is_revolute(state.robot->chain, joint)) return mass ? dot(axis, down) : algebra.constant(0.0);
  const SymbolicVector arm =
      mass ? minus(link.origin, joint_frame(state, joint).origin) : link.axes[static_cast<std::size_t>(part.axis)];
  return dot(axis, cross(arm, down));
}

Expression SymbolicWriter::warming() const {
  const auto reference = effect.settings.find("reference_celsius");
  if (reference == effect.settings.end()) return constant(0.0);
  return state.algebra().symbol(kWarming) + (state.reference_celsius - reference->second);
}

void SymbolicWriter::append(int coefficient, int place, int axis, Expression size) {
  if (!size.is(0.0)) units.push_back({coefficient, place, axis, size});
}

void SymbolicWriter::append_joint(int coefficient, Expression size) {
  append(coefficient, effect.joint, is_revolute(robot().chain, effect.joint) ? 5 : 2, size);
}

void SymbolicWriter::append_wave(Expression angle) {
  append_joint(0, cosine(angle));
  append_joint(1, sine(angle));
}

void SymbolicWriter::append_link(int coefficient, LinkParameter parameter, Expression size) {
  const auto& transforms = elementary_transforms(robot().chain.convention);
  const Elementary transform = *std::ranges::find(transforms, parameter, &Elementary::parameter);
  const SymbolicFrame seen =
      seen_from(symbolic_frame_before(*this, LinkParameter::theta), symbolic_frame_before(*this, parameter));
  const SymbolicVector& direction = seen.axes[static_cast<std::size_t>(transform.axis)];
  const SymbolicVector shift = transform.rotates ? cross(seen.origin, direction) : direction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    append(coefficient, effect.joint, axis, size * shift[i]);
    if (transform.rotates) append(coefficient, effect.joint, 3 + axis, size * direction[i]);
  }
}

void SymbolicWriter::append_rigid(int place, int count) {
  for (int axis = 0; axis < count; ++axis) append(axis, place, axis, constant(1.0));
}

std::vector<SymbolicUnit> symbolic_units(const Effect& effect, const SymbolicState& state, const std::string& name) {
  SymbolicWriter writer{effect, state, name};
  law_of(effect).append_symbolic_motions(writer);
  return writer.units;
}

}  // namespace demecal::inline effects
