#include "prediction/corrected_arm.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/law_terms.hpp"
#include "expression/simplify.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline prediction {
namespace {

/// What the effects add up to, as Displacement.
struct SymbolicDisplacement {
  std::vector<Expression> joints;
  std::vector<SymbolicMotion> places;
  SymbolicMotion sensor;

  SymbolicDisplacement(Algebra& algebra, std::size_t count)
      : joints(count, algebra.constant(0.0)),
        places(count + 1, SymbolicMotion(6, algebra.constant(0.0))),
        sensor(6, algebra.constant(0.0)) {}

  void add(const Chain& chain, const SymbolicUnit& unit, double value) {
    const auto axis = static_cast<std::size_t>(unit.axis), place = static_cast<std::size_t>(unit.place);
    Expression& sum = unit.place == kSensorPlace                                          ? sensor[axis]
                      : is_joint_motion(chain, {unit.coefficient, unit.place, unit.axis}) ? joints[place]
                                                                                          : places[place][axis];
    sum = sum + value * unit.size;
  }
};

std::vector<Expression> symbols(Algebra& algebra, int joints, std::string (*name)(int)) {
  std::vector<Expression> all;
  for (int joint = 1; joint <= joints; ++joint) all.push_back(algebra.symbol(name(joint)));
  return all;
}

Expression actual_of(const JointCorrection& correction, Expression commanded, int joint) {
  if (correction.is_neutral()) return commanded;
  const AngleBranch& branch = correction.branch();
  const Expression on_branch = branch.wraps ? wrapped_near(commanded, branch.centre_rad) : commanded;
  const Expression theta = held_within(on_branch, correction.range_rad());
  return commanded +
         commanded.algebra().formula('g' + std::to_string(joint), simplified(correction.formula()), {theta});
}

/// From the base to the flange, without base and tool.
SymbolicFrame flange(Algebra& algebra, const Chain& chain, const std::vector<Expression>& joints,
                     const std::vector<SymbolicMotion>& places) {
  SymbolicFrame frame(algebra, chain.base);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& link = chain.joints[i];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      if (transform.parameter == LinkParameter::theta) frame = moved(frame, places[i]);
      advance(frame, transform, elementary_value(link, transform.parameter, joints[i]));
    }
  }
  return moved(frame * SymbolicFrame(algebra, chain.flange), places.back());
}

SymbolicFrame tool_pose(Algebra& algebra, const CorrectedRobot& robot, const std::string& target,
                        const std::vector<Expression>& actual, const SymbolicDisplacement& by) {
  std::vector<Expression> joints = actual;
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = joints[i] + by.joints[i];
  for (const auto& [joint, from, factor] : robot.chain.couplings) {  // by commands alone: errors do not pass through
    Expression& turned = joints[static_cast<std::size_t>(joint)];
    turned = turned + factor * algebra.symbol(commanded_joint(from + 1));
  }
  const SymbolicFrame base = moved(SymbolicFrame(algebra), by.sensor) * SymbolicFrame(algebra, robot.sensor_from_base);
  return base * (flange(algebra, robot.chain, joints, by.places) * SymbolicFrame(algebra, robot.tool(target)));
}

/// What it depends on beside joints and masses; empty where on nothing.
std::string circumstances_needed(const Needs& needs) {
  std::string words;
  for (const CircumstanceWords& one : circumstances()) {
    if (needs.*one.needed) words += (words.empty() ? "" : " and ") + std::string(one.words);
  }
  return words;
}

/// A sentence on an effect that depends on more than the joints, as formulas hold it or (not `held`) leave it out;
/// empty where they hold the whole of it.
std::string note_on(const Effect& effect, const Robot& robot, bool held) {
  const std::string name =
      effect.kind + (effect.joint < 0 ? std::string() : " of joint " + std::to_string(effect.joint + 1));
  const Needs needs = law_of(effect).needs(effect, robot);
  const std::string words = circumstances_needed(needs);
  if (!held) {
    return name + " is left out" + (words.empty() ? "" : ", for it depends on " + words) + '.';
  }
  std::string note;
  if (needs.approach || needs.temperature || needs.time) note = name + " is taken with s = 0 and T = 0.";
  if (needs.torque) note = name + " is by the weight that the logged torques told of.";
  if (law_of(effect).bears_payload(effect, robot))
    note += (note.empty() ? "" : " ") + name + " is that of an arm that carries nothing.";
  return note;
}

}  // namespace

CorrectedArm corrected_arm(Algebra& algebra, const CorrectedRobot& robot, const std::string& target) {
  const int n = robot.chain.size();
  const std::vector<Expression> commanded = symbols(algebra, n, commanded_joint);
  const std::vector<Expression> actual = symbols(algebra, n, actual_joint);
  CorrectedArm arm;
  for (int i = 0; i < n; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    arm.actual.push_back(actual_of(robot.corrections[joint], commanded[joint], i + 1));
  }
  SymbolicDisplacement by(algebra, static_cast<std::size_t>(n));
  const SymbolicFrame without = tool_pose(algebra, robot, target, actual, by);
  if (robot.effects.empty()) {
    arm.pose = without.matrix();
    return arm;
  }
  SymbolicState state = symbolic_state(algebra, robot.described, commanded);
  state.tool_in_sensor = without.origin;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const Effect& effect = robot.effects[i];
    const std::vector<SymbolicUnit> units = held_units(effect, state, "effect" + std::to_string(i + 1));
    for (const SymbolicUnit& unit : units) {
      by.add(robot.chain, unit, effect.value(static_cast<std::size_t>(unit.coefficient)));
    }
    const std::string note = note_on(effect, robot.described, !units.empty());
    if (!note.empty()) arm.notes.push_back(note);
  }
  arm.pose = tool_pose(algebra, robot, target, actual, by).matrix();
  return arm;
}

Listing listing_of(const CorrectedArm& arm, const CorrectedRobot& robot, const std::string& title, PoseFrame frame) {
  Listing listing{{title}, arm.actual, arm.pose};
  std::string units;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    units += (units.empty() ? "" : ", ") + joint_symbol(joint);
    units += is_revolute(robot.chain, joint) ? " in rad" : " in m";
  }
  listing.remarks.push_back("Commanded joints: " + units + "; h1 .. hn say where the joints then are.");
  listing.remarks.emplace_back(
      frame == PoseFrame::own_base
          ? "The pose is the tool's in the frame of the arm's base as described, for where the base stands was not "
            "fitted; lengths in m, row by row."
          : "The pose is the tool's in the frame of the measurements, lengths in m, row by row.");
  for (const std::string& note : arm.notes) listing.remarks.push_back("Note: " + note);
  return listing;
}

Listing described_listing(Algebra& algebra, const CorrectedRobot& robot, const Eigen::Isometry3d& tool) {
  CorrectedRobot nominal;
  nominal.chain = robot.described.chain;
  nominal.described = robot.described;
  nominal.sensor_from_base = robot.sensor_from_base;
  nominal.tools[""] = tool;
  nominal.corrections.resize(nominal.chain.joints.size());
  return listing_of(corrected_arm(algebra, nominal, ""), nominal, "As described");
}

namespace {

double width(const Interval& range) {
  return range.upper - range.lower;
}
double middle(const Interval& range) {
  return 0.5 * (range.lower + range.upper);
}

/// x^2 (3 - 2 x).
Expression smooth_step(Expression x) {
  return x * x * (3.0 - 2.0 * x);
}

/// One joint and the range in which the effect is known of it.
struct RangedJoint {
  int joint;
  Interval range;
  bool revolute;
  Expression given;   ///< where the arm is
  Expression value;   ///< the same, of a revolute joint by whole turns near the range's middle
  Expression nearer;  ///< within the range
  Expression beyond;  ///< how far outside, else 0
};

std::vector<RangedJoint> ranged_joints(const Effect& effect, const SymbolicState& state) {
  std::vector<RangedJoint> all;
  for (const auto& [joint, range] : effect.ranges) {
    const Expression given = state.joints[static_cast<std::size_t>(joint)];
    const bool revolute = is_revolute(state.robot->chain, joint);
    const Expression value = revolute ? wrapped_near(given, middle(range)) : given;
    const Expression beyond = larger(larger(range.lower - value, value - range.upper), state.algebra().constant(0.0));
    all.push_back({joint, range, revolute, given, value, held_within(value, range), beyond});
  }
  return all;
}

/// Not negative where every joint is in its range as it stands.
Expression inside(const std::vector<RangedJoint>& joints) {
  const auto one = [](const RangedJoint& joint) {
    return smaller(joint.given - joint.range.lower, joint.range.upper - joint.given);
  };
  Expression all = one(joints.front());
  for (std::size_t i = 1; i < joints.size(); ++i) all = smaller(all, one(joints[i]));
  return all;
}

struct SymbolicHeldState {
  std::vector<Expression> joints;
  Expression weight;
};

/// The weight of the end farther from the joint: none where the ends are no neighbours.
Expression symbolic_weight_of_farther_end(const RangedJoint& joint) {
  const double unmeasured = kTurn_rad - width(joint.range);
  if (!joint.revolute || unmeasured <= 0.0) return joint.value.algebra().constant(0.0);
  return smooth_step((1.0 / unmeasured) * joint.beyond);
}

Expression farther_end(const RangedJoint& joint) {
  const Expression side = joint.value.algebra().function(Function::sign, {joint.value - middle(joint.range)});
  return middle(joint.range) - 0.5 * width(joint.range) * side;
}

std::vector<SymbolicHeldState> symbolic_held_states(const SymbolicState& state, const std::vector<RangedJoint>& joints,
                                                    bool fades) {
  Algebra& algebra = state.algebra();
  std::vector<SymbolicHeldState> all{{state.joints, algebra.constant(1.0)}};
  for (const RangedJoint& joint : joints) {
    const auto i = static_cast<std::size_t>(joint.joint);
    // Ranges of a turn and more hold the same place twice; an arm within all of them is taken as it stands.
    const bool wide = joint.revolute && width(joint.range) >= kTurn_rad;
    const Expression near =
        wide ? algebra.function(Function::if_not_negative, {inside(joints), joint.given, joint.nearer}) : joint.nearer;
    const Expression weight = fades ? algebra.constant(0.0) : symbolic_weight_of_farther_end(joint);
    const std::size_t known = all.size();
    for (std::size_t k = 0; k < known; ++k) {
      all[k].joints[i] = near;
      if (weight.is(0.0)) continue;
      SymbolicHeldState far{all[k].joints, all[k].weight * weight};
      far.joints[i] = farther_end(joint);
      all[k].weight = all[k].weight * (1.0 - weight);
      all.push_back(std::move(far));
    }
  }
  return all;
}

}  // namespace

std::vector<SymbolicUnit> held_units(const Effect& effect, const SymbolicState& state, const std::string& name) {
  if (effect.ranges.empty()) return symbolic_units(effect, state, name);
  Algebra& algebra = state.algebra();
  const bool fades = law_of(effect).fades(effect);
  const std::vector<RangedJoint> joints = ranged_joints(effect, state);
  Expression share = algebra.constant(1.0);
  for (const RangedJoint& joint : joints) {
    if (fades) share = share * smooth_step(larger(algebra.constant(0.0), 1.0 - (1.0 / kFade) * joint.beyond));
  }
  std::vector<SymbolicUnit> all;
  for (const SymbolicHeldState& anchor : symbolic_held_states(state, joints, fades)) {
    SymbolicState held = state;
    held.joints = anchor.joints;
    for (SymbolicUnit unit : symbolic_units(effect, held, name)) {
      unit.size = share * anchor.weight * unit.size;
      all.push_back(unit);
    }
  }
  return all;
}

}  // namespace demecal::inline prediction
