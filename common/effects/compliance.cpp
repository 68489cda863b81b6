// Joints that give way where gravity pushes them.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

constexpr double kSamplePayload_kg = 1.0;
const std::string kWithPayload = "with_payload", kGravityTurn = "gravity_turn";
constexpr std::string_view kAgainstLoad =
    "The joint moves against its load, which nothing elastic does: see gravity_mps2, how the arm is mounted, its "
    "masses and payload. Do not correct programs before that is known.";

/// A joint that gives way where gravity pushes it. Forms: `masses`, by the torque of known masses and the payload;
/// `payload`, of the payload alone; `moments`, of unknown masses, whose first moments times the compliance are the
/// coefficients (settings keep_3_mx: 1 say which; with_payload: 1 adds the payload's torque, known; gravity_turn: 1 or
/// 2 takes the part of gravity that a leaning mount turns about either direction across it); `tilted`, of known masses
/// where gravity leans a little from where it is said to point; `logged`, by the torque with which the drive was logged
/// to hold the joint, less friction and the sensor's zero, or where it was not logged by the weights that such torques
/// told of (settings of logged_weights()).
class ComplianceLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "compliance"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override;
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override;
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override;
  Needs needs(const Effect& effect, const Robot& /*robot*/) const override;
  std::string formula(const Effect& effect, const Robot& robot) const override;
  std::string diagnosis(const Effect& effect, const Robot& robot) const override;
  std::vector<std::string> settings() const override;
  bool requires_setting(const Effect& /*effect*/, const std::string& /*name*/) const override { return false; }
  std::vector<std::string> forms() const override { return {"masses", "payload", "moments", "tilted", "logged"}; }
  bool bears_payload(const Effect& effect, const Robot& robot) const override;
  std::string implausibility(const Effect& effect) const override;
  std::string_view reversal(const Effect& effect) const override {
    return effect.form != "moments" && effect.value(0) < 0.0 ? kAgainstLoad : std::string_view();
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override;
};

bool with_payload(const Effect& effect) {
  const auto found = effect.settings.find(kWithPayload);
  return found != effect.settings.end() && found->second != 0.0;
}

/// 0: gravity as it is said to point; 1, 2: turned a quarter about a direction across it.
std::size_t gravity_turn(const Effect& effect) {
  const auto found = effect.settings.find(kGravityTurn);
  return found == effect.settings.end() ? 0 : static_cast<std::size_t>(found->second);
}

/// Motion of unknown weight: the unit of the joint's motion, per metre of lever for masses hung on a revolute joint.
CoefficientLabel part_label(const Robot& robot, int joint, const WeightPart& part) {
  CoefficientLabel label = motion_label(robot, joint, "moment_" + name_of(part));
  if (part.axis == 3 && is_revolute(robot.chain, joint)) label = {label.name + "_per_m", "rad/m"};
  return label;
}

/// What `gravity_mps2` does to the joint through a mass (kg) whose moment about the base's origin is given.
double effort(const Robot& robot, const ArmState& state, int joint, double mass_kg, const Eigen::Vector3d& moment_kg_m,
              const Eigen::Vector3d& gravity_mps2) {
  const Eigen::Isometry3d& place = state.places[static_cast<std::size_t>(joint)];
  const Eigen::Vector3d axis = place.linear().col(2);
  if (!is_revolute(robot.chain, joint)) return mass_kg * axis.dot(gravity_mps2);
  return axis.dot((moment_kg_m - mass_kg * place.translation()).cross(gravity_mps2));
}

/// Gravity's torque on the joint, by what its drive was logged to hold it with.
double logged_torque(const Effect& effect, const Robot& robot, const ArmState& state) {
  if (state.stop.torque.size() == 0)
    return weight_torque(effect.settings, robot, state, effect.joint) + payload_torque(robot, state, effect.joint);
  return -state.drive_torque(effect.joint) - effect.setting("logged_friction") * state.approach(effect.joint) -
         effect.setting("logged_zero");
}

/// The effort of everything the joint carries under another gravity.
double effort_under(const Robot& robot, const ArmState& state, int joint, const Eigen::Vector3d& gravity_mps2) {
  double mass = state.stop.payload_kg;
  Eigen::Vector3d moment = mass * state.payload_point_m;
  for (std::size_t i = static_cast<std::size_t>(joint); i < robot.masses.size(); ++i) {
    mass += robot.masses[i].mass_kg;
    moment += robot.masses[i].mass_kg * (state.links[i] * robot.masses[i].centre_m);
  }
  return effort(robot, state, joint, mass, moment, gravity_mps2);
}

/// The state under turned gravity.
ArmState under_turned_gravity(ArmState state, std::size_t turn) {
  if (turn > 0) state.gravity_mps2 = turned_gravity(state.gravity_mps2).at(turn - 1);
  return state;
}

std::vector<CoefficientLabel> ComplianceLaw::coefficients(const Effect& effect, const Robot& robot) const {
  const CoefficientLabel plain = compliance_label(robot, effect.joint);
  if (effect.form == "tilted")
    return {plain, compliance_label(robot, effect.joint, "tilt_x"), compliance_label(robot, effect.joint, "tilt_y")};
  if (effect.form != "moments") return {plain};
  std::vector<CoefficientLabel> labels;
  for (const WeightPart& part : kept_parts(effect)) labels.push_back(part_label(robot, effect.joint, part));
  if (with_payload(effect)) labels.push_back(plain);
  return labels;
}

void ComplianceLaw::unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                                 std::vector<UnitMotion>& motions) const {
  int joint = effect.joint, coefficient = 0;
  const auto append = [&](double size) { append_joint_motion(robot, joint, coefficient++, size, motions); };
  if (effect.form == "payload") return append(payload_torque(robot, state, joint));
  if (effect.form == "moments") {
    const ArmState pulled = under_turned_gravity(state, gravity_turn(effect));
    for (const WeightPart& part : kept_parts(effect)) append(lever(robot, pulled, joint, part));
    if (with_payload(effect)) append(payload_torque(robot, state, joint));
    return;
  }
  if (effect.form == "logged") return append(logged_torque(effect, robot, state));
  append(state.torque(robot.chain, joint));
  if (effect.form != "tilted") return;
  for (const Eigen::Vector3d& gravity : turned_gravity(state.gravity_mps2))
    append(effort_under(robot, state, joint, gravity));
}

/// One part at a time, of gravity as it points and as a leaning mount would turn it.
void propose_single_parts(const Robot& robot, const std::vector<ArmState>& states, int joint,
                          std::vector<Effect>& effects) {
  for (std::size_t turn = 0; turn <= 2; ++turn) {
    std::vector<ArmState> turned;
    for (const ArmState& state : states) turned.push_back(under_turned_gravity(state, turn));
    for (const WeightPart& part : independent_parts(robot, turned, joint)) {
      effects.push_back({.kind = "compliance", .joint = joint, .settings = {}, .form = "moments"});
      effects.back().settings[std::string(kKeep) + name_of(part)] = 1.0;
      if (turn > 0) effects.back().settings[kGravityTurn] = static_cast<double>(turn);
    }
  }
}

/// Whether torques were logged, and the joint bears weight by them.
bool tell_of_weight(const Robot& robot, const Evidence& evidence, const std::vector<ArmState>& states, int joint) {
  const auto place = static_cast<std::size_t>(joint);
  if (place >= evidence.logged_weights.size()) return false;
  return std::ranges::any_of(states, [&](const ArmState& state) {
    return std::abs(weight_torque(evidence.logged_weights[place], robot, state, joint)) > kNoLoad;
  });
}

std::vector<Effect> ComplianceLaw::proposals(const Robot& robot, const Evidence& evidence) const {
  std::vector<Effect> effects;
  const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
  const std::vector<ArmState> laden = sampled_states(robot, evidence, kSamplePayload_kg);
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    const auto propose = [&](const char* form) {
      effects.push_back({.kind = "compliance", .joint = joint, .settings = {}, .form = form});
    };
    double payload = 0.0;
    for (const ArmState& state : laden) payload = std::max(payload, std::abs(payload_torque(robot, state, joint)));
    const bool payload_pulls = evidence.payload && payload > kNoLoad;
    const bool masses_pull = torques_by_size(robot, states, joint).back() > kNoLoad;
    if (evidence.masses && (masses_pull || payload_pulls)) propose("masses");
    if (payload_pulls) propose("payload");
    if (tell_of_weight(robot, evidence, states, joint)) {
      propose("logged");
      effects.back().settings = evidence.logged_weights[static_cast<std::size_t>(joint)];
    }
    if (!evidence.masses) {
      propose_single_parts(robot, states, joint, effects);
      const std::vector<WeightPart> parts = independent_parts(robot, states, joint);
      if (parts.size() < 2) continue;
      propose("moments");
      for (const WeightPart& part : parts) effects.back().settings[std::string(kKeep) + name_of(part)] = 1.0;
      if (payload_pulls) effects.back().settings[kWithPayload] = 1.0;
    } else if (masses_pull) {
      propose("tilted");
    }
  }
  return effects;
}

Needs ComplianceLaw::needs(const Effect& effect, const Robot& /*robot*/) const {
  if (effect.form == "payload") return {.payload = true};
  if (effect.form == "logged") return {.torque = true};
  if (effect.form == "moments") return {.payload = with_payload(effect)};
  return {.masses = true};
}

std::string ComplianceLaw::formula(const Effect& effect, const Robot& robot) const {
  const std::string joint = std::to_string(effect.joint + 1);
  if (effect.form == "payload") return write_joint_equation(effect, robot, {{0, "tau_payload" + joint}});
  if (effect.form == "logged") return write_joint_equation(effect, robot, {{0, "tau_logged" + joint, -1.0}});
  if (effect.form == "tilted")
    return write_joint_equation(effect, robot, {{0, "tau" + joint}, {1, "tau_x" + joint}, {2, "tau_y" + joint}});
  if (effect.form != "moments") return write_joint_equation(effect, robot, {{0, "tau" + joint}});
  const std::array<std::string, 3> levers{"lever_", "lever_turned_x_", "lever_turned_y_"};
  std::vector<Term> terms;
  for (const WeightPart& part : kept_parts(effect))
    terms.push_back({terms.size(), levers.at(gravity_turn(effect)) + name_of(part)});
  if (with_payload(effect)) terms.push_back({terms.size(), "tau_payload" + joint});
  return write_joint_equation(effect, robot, terms);
}

std::string ComplianceLaw::diagnosis(const Effect& effect, const Robot& robot) const {
  const std::string gives_way = joint_name(effect.joint) + " gives way ";
  const std::string load = load_unit(robot, effect.joint);
  const auto amount = [&](double value) { return motion_text(robot, effect.joint, value) + " per " + load; };
  if (effect.form == "payload") return gives_way + "by " + amount(effect.value(0)) + " of the payload's pull on it.";
  if (effect.form == "logged")
    return gives_way + "by " + amount(effect.value(0)) + " that its drive is logged to hold.";
  if (effect.form == "tilted") {
    const double lean = std::atan2(std::hypot(effect.value(1), effect.value(2)), std::abs(effect.value(0)));
    return gives_way + "by " + amount(effect.value(0)) + " of gravity's pull on it, and gravity leans by " +
           rounded_text(degrees(lean)) + " deg from where the robot's file says it points.";
  }
  if (effect.form != "moments") return gives_way + "by " + amount(effect.value(0)) + " of gravity's pull on it.";
  double largest = 0.0;
  const std::vector<WeightPart> parts = kept_parts(effect);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].axis < 3 || !is_revolute(robot.chain, effect.joint)) largest += std::abs(effect.value(i));
  return gives_way + "under the weight of the links beyond it, whose masses are not known: by up to " +
         motion_text(robot, effect.joint, largest) + '.';
}

bool ComplianceLaw::bears_payload(const Effect& effect, const Robot& robot) const {
  if (effect.form == "logged") return true;
  return effect.form == "moments" ? with_payload(effect) : needs(effect, robot).masses;
}

std::string ComplianceLaw::implausibility(const Effect& effect) const {
  constexpr double kLargestLean = 0.36;  // tangent of 20 degrees
  if (effect.form != "tilted") return {};
  const bool leans_too_far = std::hypot(effect.value(1), effect.value(2)) > kLargestLean * std::abs(effect.value(0));
  return leans_too_far ? "mounting tilt implausible (> 20 deg)" : "";
}

void ComplianceLaw::append_symbolic_motions(SymbolicWriter& writer) const {
  const Effect& effect = writer.effect;
  const Eigen::Vector3d& gravity = writer.robot().gravity_mps2;
  const auto turned = turned_gravity(gravity);
  int coefficient = 0;
  Expression torque = payload_torque(writer.state, effect.joint);
  if (effect.form == "payload") return writer.append_joint(coefficient, torque);
  if (effect.form == "moments") {
    const std::size_t turn = gravity_turn(effect);
    const Eigen::Vector3d& pull = turn == 0 ? gravity : turned.at(turn - 1);
    for (const WeightPart& part : kept_parts(effect))
      writer.append_joint(coefficient++, lever(writer.state, effect.joint, part, pull));
    if (with_payload(effect)) writer.append_joint(coefficient, torque);
    return;
  }
  if (effect.form == "logged") {
    for (const auto& [name, value] : effect.settings) {
      if (!name.starts_with(kLogged)) continue;
      const auto part = weight_part(std::string_view(name).substr(kLogged.size()));
      if (part) torque = torque + value * lever(writer.state, effect.joint, *part, gravity);
    }
    return writer.append_joint(coefficient, torque);
  }
  writer.append_joint(coefficient++, writer.torque(effect.joint));
  for (const Eigen::Vector3d& pull : turned)
    if (effect.form == "tilted") writer.append_joint(coefficient++, effort(writer.state, effect.joint, pull));
}

std::vector<std::string> ComplianceLaw::settings() const {
  std::vector<std::string> names{kGravityTurn};
  for (int link = 0; link < kMaxJoints; ++link)
    for (int axis = 0; axis < 4; ++axis) {
      names.push_back(std::string(kKeep) + name_of({link, axis}));
      names.push_back(std::string(kLogged) + name_of({link, axis}));
    }
  names.insert(names.end(), {"logged_friction", "logged_zero", kWithPayload});
  return names;
}

}  // namespace

const EffectLaw& compliance_law() {
  static const ComplianceLaw law;
  return law;
}

}  // namespace demecal::inline effects
