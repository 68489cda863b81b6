#include "formulas/symbolic_laws.hpp"

#include <algorithm>
#include <functional>

#include "effects/joint_words.hpp"
#include "expression/evaluate.hpp"

namespace demecal {
namespace {

/// One effect that is being written down.
struct Writing {
  const Effect& effect;
  const SymbolicState& state;
  const std::string& name;
  std::vector<SymbolicUnit> units{};

  Expression constant(double value) const { return state.algebra().constant(value); }
  Expression joint(int which) const { return state.joints[static_cast<std::size_t>(which)]; }
  Expression own_joint() const { return joint(effect.joint); }
  Expression torque(int of) const { return effort(state, of, state.robot->gravity_mps2); }
  int other_joint() const { return static_cast<int>(effect.setting("from")) - 1; }

  void append(int coefficient, int place, int axis, Expression size) {
    if (!size.is(0.0)) units.push_back({coefficient, place, axis, size});
  }
  void append_joint(int coefficient, Expression size) {
    append(coefficient, effect.joint, is_revolute(*state.robot, effect.joint) ? 5 : 2, size);
  }
  void append_wave(Expression angle) {
    append_joint(0, cosine(angle));
    append_joint(1, sine(angle));
  }
};

void rigid(Writing& writing, int place, int count) {
  for (int axis = 0; axis < count; ++axis) writing.append(axis, place, axis, writing.constant(1.0));
}

void registration(Writing& writing) {
  rigid(writing, kSensorPlace, 6);
}

void tool(Writing& writing) {
  rigid(writing, writing.state.robot->chain.size(), writing.effect.form == "pose" ? 6 : 3);
}

LinkParameter parameter_of(const std::string& label) {
  const std::string stem = label.substr(0, label.find('_'));
  if (stem == "theta") return LinkParameter::theta;
  if (stem == "d") return LinkParameter::d;
  if (stem == "a") return LinkParameter::a;
  return stem == "alpha" ? LinkParameter::alpha : LinkParameter::beta;
}

/// The frame in which the link's transform `parameter` acts, from where the link begins.
SymbolicFrame frame_before(const Writing& writing, LinkParameter parameter) {
  const Chain& chain = writing.state.robot->chain;
  const Joint& link = chain.joints[static_cast<std::size_t>(writing.effect.joint)];
  const LinkParameter variable = link.type == JointType::revolute ? LinkParameter::theta : LinkParameter::d;
  SymbolicFrame frame(writing.state.algebra());
  for (const Elementary& transform : elementary_transforms(chain.convention)) {
    if (transform.parameter == parameter) break;
    const Expression fixed = writing.constant(link.parameter(transform.parameter));
    advance(frame, transform, transform.parameter == variable ? writing.own_joint() + fixed : fixed);
  }
  return frame;
}

/// A change of a link parameter: its transform's screw, seen from the joint's place.
void link_motion(Writing& writing, int coefficient, LinkParameter parameter) {
  const auto& transforms = elementary_transforms(writing.state.robot->chain.convention);
  const Elementary transform = *std::ranges::find(transforms, parameter, &Elementary::parameter);
  const SymbolicFrame seen = seen_from(frame_before(writing, LinkParameter::theta), frame_before(writing, parameter));
  const SymbolicVector& direction = seen.axes[static_cast<std::size_t>(transform.axis)];
  const SymbolicVector shift = transform.rotates ? cross(seen.origin, direction) : direction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    writing.append(coefficient, writing.effect.joint, axis, shift[i]);
    if (transform.rotates) writing.append(coefficient, writing.effect.joint, 3 + axis, direction[i]);
  }
}

void geometry(Writing& writing) {
  int coefficient = 0;
  for (const CoefficientLabel& label : law_of(writing.effect).coefficients(writing.effect, *writing.state.robot)) {
    link_motion(writing, coefficient++, parameter_of(label.name));
  }
}

void compliance(Writing& writing) {
  const Eigen::Vector3d& gravity = writing.state.robot->gravity_mps2;
  const int joint = writing.effect.joint;
  const auto turned = turned_gravity(gravity);
  int coefficient = 0;
  if (writing.effect.form == "payload") return;
  if (writing.effect.form == "moments") {
    const auto turn = writing.effect.settings.find("gravity_turn");
    const auto which = turn == writing.effect.settings.end() ? 0U : static_cast<std::size_t>(turn->second);
    const Eigen::Vector3d& pulls = which == 0 ? gravity : turned.at(which - 1);
    for (const WeightPart& part : kept_parts(writing.effect)) {
      writing.append_joint(coefficient++, lever(writing.state, joint, part, pulls));
    }
    return;
  }
  writing.append_joint(coefficient++, writing.torque(joint));
  if (writing.effect.form != "tilted") return;
  for (const Eigen::Vector3d& pulls : turned) {
    writing.append_joint(coefficient++, effort(writing.state, joint, pulls));
  }
}

void link_bending(Writing& writing) {
  const SymbolicVector moment = gravity_moment(writing.state, writing.effect.joint);
  for (int axis = 0; axis < 2; ++axis) {
    writing.append(axis, writing.effect.joint, 3 + axis, moment[static_cast<std::size_t>(axis)]);
  }
}

void backlash(Writing& writing) {
  if (writing.effect.form != "seated") return;  // the other forms are of the approach
  const double load = writing.effect.setting("torque0_nm");
  const Expression share = writing.torque(writing.effect.joint) / writing.constant(load);
  writing.append_joint(0, 0.5 * writing.state.algebra().function(Function::hyperbolic_tangent, {share}));
}

void axis_wobble(Writing& writing) {
  const Expression angle = writing.effect.setting("order") * writing.own_joint();
  for (int axis = 0; axis < 2; ++axis) {
    writing.append(axis, writing.effect.joint, 3 + axis, cosine(angle));
    writing.append(2 + axis, writing.effect.joint, 3 + axis, sine(angle));
  }
}

void sensor_scale(Writing& writing) {
  for (int axis = 0; axis < 3; ++axis) {
    writing.append(0, kSensorPlace, axis, writing.state.tool_in_sensor[static_cast<std::size_t>(axis)]);
  }
}

/// The formula with its variables counted anew, of those alone that it speaks of, and what they stand for.
struct Spoken {
  Tree formula;
  std::vector<Expression> arguments;
};

Spoken spoken(const Writing& writing) {
  const std::size_t joints = writing.state.joints.size();
  Spoken result{writing.effect.formula, {}};
  std::map<std::uint8_t, std::uint8_t> places;
  for (const Node& node : result.formula) {
    if (node.primitive == Primitive::variable) places.try_emplace(node.variable, 0);
  }
  for (auto& [variable, place] : places) {
    place = static_cast<std::uint8_t>(result.arguments.size());
    const bool torque = variable == joints;  // behind it s and T, of which nothing is known
    result.arguments.push_back(variable < joints ? writing.joint(variable)
                               : torque          ? writing.torque(writing.effect.joint)
                                                 : writing.constant(0.0));
  }
  for (Node& node : result.formula) {
    if (node.primitive == Primitive::variable) node.variable = places.at(node.variable);
  }
  return result;
}

void symbolic(Writing& writing) {
  const Spoken of = spoken(writing);
  const Expression value = of.arguments.empty()
                               ? writing.constant(evaluate(of.formula, {}))
                               : writing.state.algebra().formula(writing.name, of.formula, of.arguments);
  if (writing.effect.form == "wave") return writing.append_wave(value);
  writing.append_joint(0, value);
}

/// How each kind is written; an empty one does nothing where only the joints are known.
const std::map<std::string, std::function<void(Writing&)>>& laws() {
  const auto nothing = [](Writing&) {};
  static const std::map<std::string, std::function<void(Writing&)>> all{
      {"registration", registration},
      {"tool", tool},
      {"joint_offset", [](Writing& writing) { writing.append_joint(0, writing.constant(1.0)); }},
      {"geometry", geometry},
      {"gain", [](Writing& writing) { writing.append_joint(0, writing.own_joint()); }},
      {"eccentricity",
       [](Writing& writing) { writing.append_wave(writing.effect.setting("order") * writing.own_joint()); }},
      {"gear_harmonic",
       [](Writing& writing) { writing.append_wave(writing.effect.setting("ratio") * writing.own_joint()); }},
      {"compliance", compliance},
      {"link_bending", link_bending},
      {"coupling",
       [](Writing& writing) {
         const Expression from = writing.joint(writing.other_joint());
         if (writing.effect.form == "harmonic") return writing.append_wave(from);
         writing.append_joint(0, from);
       }},
      {"backlash", backlash},
      {"hysteresis", nothing},
      {"axis_wobble", axis_wobble},
      {"thermal_offset", nothing},
      {"thermal_length", nothing},
      {"drift", nothing},
      {"sensor_scale", sensor_scale},
      {"symbolic", symbolic}};
  return all;
}

}  // namespace

std::vector<SymbolicUnit> symbolic_units(const Effect& effect, const SymbolicState& state, const std::string& name) {
  Writing writing{effect, state, name};
  const auto law = laws().find(effect.kind);
  if (law != laws().end()) law->second(writing);
  return writing.units;
}

}  // namespace demecal
