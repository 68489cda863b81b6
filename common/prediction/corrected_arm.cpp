#include "prediction/corrected_arm.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "effects/arm_state.hpp"
#include "effects/law_terms.hpp"
#include "expression/simplify.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "symbolic/calculus.hpp"

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
  return commanded + added_by(correction, commanded, 'g' + std::to_string(joint));
}

/// From the base to the flange, without base and tool; `turned` gets the frames about whose z axes joints move.
SymbolicFrame flange(Algebra& algebra, const Chain& chain, const std::vector<Expression>& joints,
                     const std::vector<SymbolicMotion>& places, std::vector<SymbolicFrame>& turned) {
  SymbolicFrame frame(algebra, chain.base);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& link = chain.joints[i];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      if (transform.parameter == LinkParameter::theta) {
        frame = moved(frame, places[i]);
        turned.push_back(frame);
      }
      advance(frame, transform, elementary_value(link, transform.parameter, joints[i]));
    }
  }
  return moved(frame * SymbolicFrame(algebra, chain.flange), places.back());
}

std::vector<Expression> driven_by(Algebra& algebra, const Chain& chain, const std::vector<Expression>& actual,
                                  const SymbolicDisplacement& by) {
  std::vector<Expression> joints = actual;
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = joints[i] + by.joints[i];
  for (const auto& [joint, from, factor] : chain.couplings) {  // by commands alone: errors do not pass through
    Expression& turned = joints[static_cast<std::size_t>(joint)];
    turned = turned + factor * algebra.symbol(commanded_joint(from + 1));
  }
  return joints;
}

/// Where the tool stands, and on the way there the frames about whose z axes joints move.
struct PosedArm {
  SymbolicFrame tool;
  std::vector<SymbolicFrame> turned;
};

PosedArm posed_arm(Algebra& algebra, const CorrectedRobot& robot, const std::string& target,
                   const std::vector<Expression>& actual, const SymbolicDisplacement& by) {
  const std::vector<Expression> joints = driven_by(algebra, robot.chain, actual, by);
  const SymbolicFrame base = moved(SymbolicFrame(algebra), by.sensor) * SymbolicFrame(algebra, robot.sensor_from_base);
  std::vector<SymbolicFrame> turned;
  const SymbolicFrame end =
      flange(algebra, robot.chain, joints, by.places, turned) * SymbolicFrame(algebra, robot.tool(target));
  for (SymbolicFrame& frame : turned) frame = base * frame;
  return {base * end, turned};
}

/// How fast a joint that stands at `driven` follows its own command, by what depends on that alone. Evolved formulas
/// of effects are left out: their derivatives would be further functions.
Expression rate_of(Expression driven, Expression corrected, int joint) {
  Algebra& algebra = driven.algebra();
  const std::string own = commanded_joint(joint), actual = actual_joint(joint);
  const bool as_commanded = corrected->kind == ExpressionKind::symbol;
  const Expression slope = as_commanded ? algebra.constant(1.0) : algebra.symbol(actual_rate(joint));
  Expression rate = algebra.constant(0.0);
  const std::vector<Part> whole{{driven, 1.0}};
  for (const auto& [part, coefficient] : driven->kind == ExpressionKind::sum ? driven->parts : whole) {
    const std::vector<Expression> terms = terms_of({&part, 1});
    const bool alone = std::ranges::all_of(terms, [&](Expression term) {
      if (term->kind == ExpressionKind::function) return term->function != Function::formula;
      return term->kind != ExpressionKind::symbol || term->name == own || term->name == actual;
    });
    if (!alone) continue;
    rate = rate + coefficient * (derivative(part, own) + derivative(part, actual) * slope);
  }
  return rate;
}

std::vector<MovingAxis> axes_of(const Chain& chain, const PosedArm& posed, const CorrectedArm& arm) {
  std::vector<MovingAxis> axes;
  for (std::size_t i = 0; i < arm.driven.size(); ++i) {
    const SymbolicVector& z = posed.turned[i].axes[2];
    const SymbolicVector& next = i + 1 < arm.driven.size() ? posed.turned[i + 1].origin : posed.tool.origin;
    const SymbolicVector way = minus(next, posed.turned[i].origin);
    axes.push_back({is_revolute(chain.joints[i]),
                    {z[0], z[1], z[2]},
                    {way[0], way[1], way[2]},
                    rate_of(arm.driven[i], arm.actual[i], static_cast<int>(i + 1))});
  }
  for (const auto& [joint, from, factor] : chain.couplings)
    axes[static_cast<std::size_t>(joint)].coupled.emplace_back(static_cast<std::size_t>(from), factor);
  return axes;
}

/// What it depends on beside joints and masses; empty where on nothing.
std::string circumstances_needed(const Needs& needs) {
  std::string words;
  for (const CircumstanceWords& one : circumstances()) {
    if (needs.*one.needed) words += (words.empty() ? "" : " and ") + std::string(one.words);
  }
  return words;
}

/// A sentence on an effect that formulas leave out (not `held`) or do not hold as it was measured; else empty.
std::string note_on(const Effect& effect, const Robot& robot, bool held) {
  const std::string name =
      effect.kind + (effect.joint < 0 ? std::string() : " of joint " + std::to_string(effect.joint + 1));
  const Needs needs = law_of(effect).needs(effect, robot);
  const std::string words = circumstances_needed(needs);
  if (!held) {
    return name + " is left out" + (words.empty() ? "" : ", for it depends on " + words) + '.';
  }
  return needs.torque ? name + " is by the weight that the logged torques told of." : "";
}

/// On what the pose depends beside the joints; empty where on nothing.
std::string circumstances_sentence(const CorrectedArm& arm) {
  std::set<std::string> symbols;
  for (const Expression term : terms_of(elements(arm.pose)))
    if (term->kind == ExpressionKind::symbol) symbols.insert(term->name);
  std::vector<std::string> words;
  if (symbols.contains(kPayload)) words.push_back(std::string(kPayload) + " (carried at the tool point as described)");
  if (symbols.contains(kWarming))
    words.push_back(std::string(kWarming) + " (above " + number_text(arm.reference_celsius) + " degC)");
  std::string sides;
  for (std::size_t i = 1; i <= arm.actual.size(); ++i)
    if (symbols.contains(approach_symbol(static_cast<int>(i))))
      sides += (sides.empty() ? "" : ", ") + approach_symbol(static_cast<int>(i));
  if (!sides.empty()) words.push_back(sides + " (the sign of the joint's last motion; 0 where it is not known)");
  std::string all;
  for (const std::string& one : words) all += (all.empty() ? "" : ", ") + one;
  return all.empty() ? "" : "The pose depends also on " + all + "; left out, they are 0.";
}

}  // namespace

Expression added_by(const JointCorrection& correction, Expression commanded, const std::string& name) {
  Algebra& algebra = commanded.algebra();
  if (correction.is_neutral()) return algebra.constant(0.0);
  const AngleBranch& branch = correction.branch();
  const Expression on_branch = branch.wraps ? wrapped_near(commanded, branch.centre_rad) : commanded;
  return algebra.formula(name, simplified(correction.formula()), {held_within(on_branch, correction.range_rad())});
}

CorrectedArm corrected_arm(Algebra& algebra, const CorrectedRobot& robot, const std::string& target,
                           const std::string& effects) {
  const int n = robot.chain.size();
  const std::vector<Expression> commanded = symbols(algebra, n, commanded_joint);
  const std::vector<Expression> actual = symbols(algebra, n, actual_joint);
  CorrectedArm arm;
  for (int i = 0; i < n; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    arm.actual.push_back(actual_of(robot.corrections[joint], commanded[joint], i + 1));
  }
  SymbolicDisplacement by(algebra, static_cast<std::size_t>(n));
  const PosedArm without = posed_arm(algebra, robot, target, actual, by);
  arm.driven = driven_by(algebra, robot.chain, actual, by);
  arm.places = by.places;
  if (robot.effects.empty()) {
    arm.pose = without.tool.matrix();
    arm.axes = axes_of(robot.chain, without, arm);
    return arm;
  }
  SymbolicState state = symbolic_state(algebra, robot.described, commanded);
  for (const Effect& effect : robot.effects) {
    if (!effect.settings.contains("reference_celsius")) continue;
    arm.reference_celsius = effect.setting("reference_celsius");
    break;
  }
  state.reference_celsius = arm.reference_celsius;
  state.tool_in_sensor = without.tool.origin;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const Effect& effect = robot.effects[i];
    const std::vector<SymbolicUnit> units = held_units(effect, state, effects + std::to_string(i + 1));
    for (const SymbolicUnit& unit : units) {
      by.add(robot.chain, unit, effect.value(static_cast<std::size_t>(unit.coefficient)));
      arm.units.push_back({i, unit});
    }
    const std::string note = note_on(effect, robot.described, !units.empty());
    if (!note.empty()) arm.notes.push_back(note);
  }
  const PosedArm posed = posed_arm(algebra, robot, target, actual, by);
  arm.pose = posed.tool.matrix();
  arm.driven = driven_by(algebra, robot.chain, actual, by);
  arm.axes = axes_of(robot.chain, posed, arm);
  arm.places = by.places;
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
  listing.reference_celsius = arm.reference_celsius;
  listing.axes = arm.axes;
  const std::string more = circumstances_sentence(arm);
  if (!more.empty()) listing.remarks.push_back(more);
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

}  // namespace demecal::inline prediction
