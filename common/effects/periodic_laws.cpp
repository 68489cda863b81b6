// What comes back with every turn of a joint: eccentricity, gear harmonics, and the wobble of its axis.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"
#include "symbolic/algebra.hpp"

namespace demecal::inline effects {
namespace {

/// A joint that swings to either side so many periods a turn; a setting says how many.
class JointWaveLaw : public EffectLaw {
 public:
  explicit JointWaveLaw(const char* setting) : setting_(setting) {}

  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    return {motion_label(robot, effect.joint, "cosine"), motion_label(robot, effect.joint, "sine")};
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double angle = periods(effect) * state.joints()[effect.joint];
    append_joint_motion(robot, effect.joint, 0, std::cos(angle), motions);
    append_joint_motion(robot, effect.joint, 1, std::sin(angle), motions);
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_joint_equation(effect, robot, harmonic_terms(periods(effect), effect.joint));
  }
  std::vector<std::string> settings() const override { return {setting_}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
  std::optional<HeldMotion> held_motion(const Effect& effect) const override {
    const double amplitude = std::hypot(effect.value(0), effect.value(1));
    const double fading = fades(effect) ? 1.5 / kFade : 0.0;  // at its steepest
    return HeldMotion{effect.joint, amplitude * (periods(effect) + fading), 2.0 * amplitude};
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    writer.append_wave(periods(writer.effect) * writer.own_joint());
  }

 protected:
  double periods(const Effect& effect) const { return effect.setting(setting_); }

 private:
  std::string setting_;
};

/// Whether a balance spring that the robot's file does not describe may hang at the joint: one of the first three,
/// turned by weight.
bool may_have_a_balancer(const Robot& robot, int joint) {
  constexpr int kBalanced = 3;
  constexpr double kAlong = 0.9;  // cosine
  if (joint >= kBalanced ||
      std::ranges::any_of(robot.balancers, [&](const Balancer& one) { return one.joint == joint; }))
    return false;
  const ArmState state = arm_state(robot, Stop(JointVector::Zero(robot.chain.size())));
  const Eigen::Vector3d axis = state.places[static_cast<std::size_t>(joint)].linear().col(2);
  return std::abs(axis.dot(robot.gravity_mps2)) < kAlong * robot.gravity_mps2.norm();
}

/// A gear or encoder disc off its centre: one or two periods a turn.
class EccentricityLaw final : public JointWaveLaw {
 public:
  EccentricityLaw() : JointWaveLaw("order") {}
  std::string_view kind() const override { return "eccentricity"; }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot.chain, joint)) continue;
      for (const double order : {1.0, 2.0}) {
        effects.push_back({.kind = "eccentricity", .joint = joint, .settings = {{"order", order}}});
      }
    }
    return effects;
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return joint_name(effect.joint) + " swings by " +
           motion_text(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) + " to either side, " +
           times_per_turn(periods(effect)) + ": a gear or encoder disc runs off its centre" +
           (may_have_a_balancer(robot, effect.joint) ? ", or a balance spring pulls that the robot's file does not "
                                                       "describe (balancers)."
                                                     : ".");
  }
  bool is_smooth(const Effect& /*effect*/) const override { return true; }
};

constexpr double kRipple = 6.0;       // so many periods a turn and more average out where nothing is known of them
constexpr int kLinesOfGear = 4;       // of an input turn, once to so many times
constexpr int kLowestRatio = 3;       // one and two periods a turn are eccentricity
constexpr double kSmoothRatio = 3.0;  // up to which a joint correction holds it
constexpr double kImpossibleRatio =
    1.7320508;  // times the highest scanned: no ratio of integers near it, and beyond the scan

/// The transmission error of a gear stage: N periods a turn of the joint.
class GearHarmonicLaw final : public JointWaveLaw {
 public:
  GearHarmonicLaw() : JointWaveLaw("ratio") {}
  std::string_view kind() const override { return "gear_harmonic"; }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot.chain, joint)) continue;
      for (const double ratio : ratios_to_try(robot.chain.joints[static_cast<std::size_t>(joint)].gear, evidence)) {
        effects.push_back({.kind = "gear_harmonic", .joint = joint, .settings = {{"ratio", ratio}}});
      }
    }
    return effects;
  }
  bool fades(const Effect& effect) const override { return periods(effect) >= kRipple; }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    return joint_name(effect.joint) + " swings by " +
           motion_text(robot, effect.joint, std::hypot(effect.value(0), effect.value(1))) + " to either side, " +
           times_per_turn(periods(effect)) + ": the transmission error of " +
           of_gear(robot.chain.joints[static_cast<std::size_t>(effect.joint)].gear, periods(effect)) + '.';
  }
  bool is_harmonic() const override { return true; }
  bool is_smooth(const Effect& effect) const override { return periods(effect) <= kSmoothRatio; }
  std::optional<DecoyEffect> decoy(const Effect& effect, const Evidence& evidence) const override {
    Effect impossible = effect;
    impossible.settings["ratio"] = kImpossibleRatio * evidence.highest_ratio;
    return DecoyEffect{std::move(impossible), DecoyKind::wrong_ratio};
  }

 private:
  /// The scan, what is stated of all joints, and the lines of the joint's own gear: once to four times an input turn,
  /// and of a cycloidal one the passing of its pins, of which it has one more than its ratio.
  static std::vector<double> ratios_to_try(const std::optional<Gear>& gear, const Evidence& evidence) {
    std::vector<double> ratios, stated = evidence.stated_ratios;
    if (gear)
      for (int line = 1; line <= kLinesOfGear; ++line) stated.push_back(line * gear->ratio);
    if (gear && gear->kind == GearKind::cycloidal) stated.push_back(gear->ratio + 1.0);
    for (int ratio = kLowestRatio; ratio <= evidence.highest_ratio; ++ratio) ratios.push_back(ratio);
    for (const double each : stated)
      if (each > 0.0 && std::ranges::find(ratios, each) == ratios.end()) ratios.push_back(each);
    return ratios;
  }

  /// "a strain wave gear, 2 times an input turn", where the joint's gear is stated.
  static std::string of_gear(const std::optional<Gear>& gear, double periods) {
    constexpr std::array<const char*, 4> kNames{"a strain wave gear", "a cycloidal gear", "a planetary gear",
                                                "a spur gear"};
    constexpr double kSame = 1e-6;
    if (!gear) return "a gear stage";
    const std::string name = kNames.at(static_cast<std::size_t>(gear->kind));
    if (gear->kind == GearKind::cycloidal && std::abs(periods - gear->ratio - 1.0) < kSame)
      return name + ", as its pins pass";
    const double lines = std::round(periods / gear->ratio);
    if (lines < 1.0 || std::abs(periods - lines * gear->ratio) > kSame * periods)
      return "a stage behind or before its gear, of whose ratio, " + rounded_text(gear->ratio) + ", it is no multiple";
    return name + ", " +
           (lines == 1.0   ? "once"
            : lines == 2.0 ? "twice"
                           : rounded_text(lines) + " times") +
           " an input turn";
  }
};

/// A turning axis that tilts about x and y of its own place, once or twice a turn.
class AxisWobbleLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "axis_wobble"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"cosine_x_rad", "rad"}, {"cosine_y_rad", "rad"}, {"sine_x_rad", "rad"}, {"sine_y_rad", "rad"}};
  }
  void unit_motions(const Effect& effect, const Robot& /*robot*/, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    const double angle = effect.setting("order") * state.joints()[effect.joint];
    for (int axis = 0; axis < 2; ++axis) {
      motions.push_back({axis, effect.joint, 3 + axis, std::cos(angle)});
      motions.push_back({2 + axis, effect.joint, 3 + axis, std::sin(angle)});
    }
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) {
      if (!is_revolute(robot.chain, joint)) continue;
      for (const double order : {1.0, 2.0}) {
        effects.push_back({.kind = "axis_wobble", .joint = joint, .settings = {{"order", order}}});
      }
    }
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    const std::vector<Term> harmonic = harmonic_terms(effect.setting("order"), effect.joint);
    const std::string joint = std::to_string(effect.joint + 1);
    return write_equations(effect, robot,
                           {{"tilt_x" + joint, {{0, harmonic[0].factor}, {2, harmonic[1].factor}}},
                            {"tilt_y" + joint, {{1, harmonic[0].factor}, {3, harmonic[1].factor}}}});
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The axis of joint " + std::to_string(effect.joint + 1) + " wobbles as it turns, " +
           times_per_turn(effect.setting("order")) + ": by up to " +
           angle_text(std::hypot(effect.value(0), effect.value(2))) + " about its x and " +
           angle_text(std::hypot(effect.value(1), effect.value(3))) + " about its y, as a bearing off its seat does.";
  }
  std::vector<std::string> settings() const override { return {"order"}; }
  std::vector<int> ranged_joints(const Effect& effect, const Robot& /*robot*/) const override { return {effect.joint}; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    const Expression angle = writer.effect.setting("order") * writer.own_joint();
    for (int axis = 0; axis < 2; ++axis) {
      writer.append(axis, writer.effect.joint, 3 + axis, cosine(angle));
      writer.append(2 + axis, writer.effect.joint, 3 + axis, sine(angle));
    }
  }
};

}  // namespace

const EffectLaw& eccentricity_law() {
  static const EccentricityLaw law;
  return law;
}

const EffectLaw& gear_harmonic_law() {
  static const GearHarmonicLaw law;
  return law;
}

const EffectLaw& axis_wobble_law() {
  static const AxisWobbleLaw law;
  return law;
}

}  // namespace demecal::inline effects
