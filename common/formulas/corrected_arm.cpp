#include "formulas/corrected_arm.hpp"

#include <algorithm>

#include "effects/law_terms.hpp"
#include "expression/simplify.hpp"
#include "formulas/held_units.hpp"

namespace demecal::inline formulas {
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
  SymbolicFrame frame(algebra);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& link = chain.joints[i];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      if (transform.parameter == LinkParameter::theta) frame = moved(frame, places[i]);
      advance(frame, transform, elementary_value(link, transform.parameter, joints[i]));
    }
  }
  return moved(frame, places.back());
}

SymbolicFrame tool_pose(Algebra& algebra, const CorrectedRobot& robot, const std::string& target,
                        const std::vector<Expression>& actual, const SymbolicDisplacement& by) {
  std::vector<Expression> joints = actual;
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = joints[i] + by.joints[i];
  const SymbolicFrame base = moved(SymbolicFrame(algebra), by.sensor) * SymbolicFrame(algebra, robot.sensor_from_base);
  return base * (flange(algebra, robot.chain, joints, by.places) * SymbolicFrame(algebra, robot.tool(target)));
}

/// What it depends on beside joints and masses, by law.needs(); empty where on nothing.
std::string circumstances(const Needs& needs) {
  std::string words;
  const auto add = [&](bool needed, const char* word) {
    if (needed) words += (words.empty() ? "" : " and ") + std::string(word);
  };
  add(needs.approach, "the side from which joints come");
  add(needs.payload, "the payload");
  add(needs.temperature, "the temperature");
  add(needs.time, "the time");
  return words;
}

/// A sentence on an effect that depends on more than the joints, as formulas hold it or (not `held`) leave it out;
/// empty where they hold the whole of it.
std::string note_on(const Effect& effect, const Robot& robot, bool held) {
  const std::string name =
      effect.kind + (effect.joint < 0 ? std::string() : " of joint " + std::to_string(effect.joint + 1));
  const Needs needs = law_of(effect).needs(effect, robot);
  const std::string words = circumstances(needs);
  if (!held) {
    return name + " is left out" + (words.empty() ? "" : ", for it depends on " + words) + '.';
  }
  std::string note;
  if (needs.approach || needs.temperature || needs.time) note = name + " is taken with s = 0 and T = 0.";
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

Listing listing_of(const CorrectedArm& arm, const CorrectedRobot& robot, const std::string& title) {
  Listing listing{{title}, arm.actual, arm.pose};
  std::string units;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    units += (units.empty() ? "" : ", ") + joint_symbol(joint);
    units += is_revolute(robot.chain, joint) ? " in rad" : " in m";
  }
  listing.remarks.push_back("Commanded joints: " + units + "; h1 .. hn say where the joints then are.");
  listing.remarks.emplace_back("The pose is the tool's in the frame of the measurements, lengths in m, row by row.");
  for (const std::string& note : arm.notes) listing.remarks.push_back("Note: " + note);
  return listing;
}

}  // namespace demecal::inline formulas
