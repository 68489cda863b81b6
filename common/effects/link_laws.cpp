// Links that are not as drawn, and that bend under weight.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {
namespace {

struct FreeParameter {
  LinkParameter parameter;
  std::string symbol;
  std::string unit;
};

/// What of a link is free beside its joint's offset: d, a and alpha, beta in place of d between near-parallel axes; of
/// a prismatic joint, which has a direction but no place, two angles.
std::vector<FreeParameter> free_parameters_of(const Robot& robot, int joint) {
  const bool parallel = leads_between_parallels(robot.chain, joint, kNearParallel_rad);
  const FreeParameter beta{LinkParameter::beta, "beta", "rad"}, alpha{LinkParameter::alpha, "alpha", "rad"};
  if (!is_revolute(robot.chain, joint))
    return {parallel ? beta : FreeParameter{LinkParameter::theta, "theta", "rad"}, alpha};
  return {parallel ? beta : FreeParameter{LinkParameter::d, "d", "m"}, {LinkParameter::a, "a", "m"}, alpha};
}

/// A link that is not as drawn.
class GeometryLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "geometry"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override {
    std::vector<CoefficientLabel> labels;
    for (const FreeParameter& free : free_parameters_of(robot, effect.joint))
      labels.push_back({free.symbol + '_' + free.unit, free.unit});
    return labels;
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    int coefficient = 0;
    for (const FreeParameter& free : free_parameters_of(robot, effect.joint)) {
      append_link_motion(robot.chain, effect.joint, state.driven[effect.joint], free.parameter, coefficient++, 1.0,
                         motions);
    }
  }
  std::vector<Effect> proposals(const Robot& robot, const Evidence& /*evidence*/) const override {
    std::vector<Effect> effects;
    for (int joint = 0; joint < robot.chain.size(); ++joint) effects.push_back({.kind = "geometry", .joint = joint});
    return effects;
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    std::vector<Equation> equations;
    for (const FreeParameter& free : free_parameters_of(robot, effect.joint)) {
      equations.push_back({'d' + free.symbol + std::to_string(effect.joint + 1), {{equations.size(), ""}}});
    }
    return write_equations(effect, robot, equations);
  }
  std::string diagnosis(const Effect& effect, const Robot& robot) const override {
    std::string amounts;
    std::size_t coefficient = 0;
    for (const FreeParameter& free : free_parameters_of(robot, effect.joint)) {
      const double value = effect.value(coefficient++);
      amounts += (amounts.empty() ? "" : ", ") + free.symbol + " by " +
                 (free.unit == "m" ? length_text(value) : angle_text(value));
    }
    return "Link " + std::to_string(effect.joint + 1) + " is not as drawn: " + amounts + '.';
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    int coefficient = 0;
    for (const FreeParameter& free : free_parameters_of(writer.robot(), writer.effect.joint)) {
      writer.append_link(coefficient++, free.parameter, writer.constant(1.0));
    }
  }
};

const Eigen::Vector3d& moment_nm(const ArmState& state, int joint) {
  return state.loads[static_cast<std::size_t>(joint)].moment_nm;
}

/// A bearing, and the link before it, that give way across the axis under the moment of gravity there. Forms: `masses`,
/// by the moment of known masses and the payload, about x and about y; `moments`, alike about both, by that of unknown
/// masses, whose first moments times the compliance are the coefficients (settings keep_3_mx: 1 say which): of joint 1,
/// the base, alone is it tried.
class LinkBendingLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "link_bending"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& robot) const override;
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override;
  std::vector<Effect> proposals(const Robot& robot, const Evidence& evidence) const override;
  Needs needs(const Effect& effect, const Robot& /*robot*/) const override { return {.masses = !of_parts(effect)}; }
  std::string formula(const Effect& effect, const Robot& robot) const override;
  std::string diagnosis(const Effect& effect, const Robot& robot) const override;
  std::vector<std::string> settings() const override;
  bool requires_setting(const Effect& /*effect*/, const std::string& /*name*/) const override { return false; }
  std::vector<std::string> forms() const override { return {"masses", "moments"}; }
  std::string implausibility(const Effect& effect) const override;
  std::string_view advice(const Effect& effect) const override {
    if (effect.joint > 0) return {};
    return "What carries the arm tilts: have the base's bolts, what it stands on and the bearing of joint 1 checked. "
           "Corrected targets compensate it for the payload that was measured.";
  }
  void append_symbolic_motions(SymbolicWriter& writer) const override;

 private:
  static bool of_parts(const Effect& effect) { return effect.form == "moments"; }
};

std::vector<CoefficientLabel> LinkBendingLaw::coefficients(const Effect& effect, const Robot& /*robot*/) const {
  if (!of_parts(effect)) return {{"x_rad_per_nm", "rad/Nm"}, {"y_rad_per_nm", "rad/Nm"}};
  std::vector<CoefficientLabel> labels;
  for (const WeightPart& part : kept_parts(effect)) {
    const bool mass = part.axis == 3;
    labels.push_back({"moment_" + name_of(part) + (mass ? "_rad_per_m" : "_rad"), mass ? "rad/m" : "rad"});
  }
  return labels;
}

void LinkBendingLaw::unit_motions(const Effect& effect, const Robot& /*robot*/, const ArmState& state,
                                  std::vector<UnitMotion>& motions) const {
  if (!of_parts(effect)) {
    for (int axis = 0; axis < 2; ++axis) {
      motions.push_back({axis, effect.joint, 3 + axis, moment_nm(state, effect.joint)[axis]});
    }
    return;
  }
  int coefficient = 0;
  for (const WeightPart& part : kept_parts(effect)) {
    const Eigen::Vector3d moment = lever_moment(state, effect.joint, part);
    for (int axis = 0; axis < 2; ++axis) motions.push_back({coefficient, effect.joint, 3 + axis, moment[axis]});
    ++coefficient;
  }
}

std::vector<Effect> LinkBendingLaw::proposals(const Robot& robot, const Evidence& evidence) const {
  std::vector<Effect> effects;
  const std::vector<ArmState> states = sampled_states(robot, evidence, 0.0);
  if (!evidence.masses) {
    const std::vector<WeightPart> parts = tilting_parts(robot, states, 0);
    const auto propose = [&] {
      effects.push_back({.kind = "link_bending", .joint = 0, .settings = {}, .form = "moments"});
    };
    const auto keep = [&](const WeightPart& part) {
      effects.back().settings[std::string(kKeep) + name_of(part)] = 1.0;
    };
    for (const WeightPart& part : parts) {
      propose();
      keep(part);
    }
    if (parts.size() < 2) return effects;
    propose();
    std::ranges::for_each(parts, keep);
    return effects;
  }
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    const auto bends = [&](const ArmState& state) { return moment_nm(state, joint).head<2>().norm() > kNoLoad; };
    if (std::ranges::any_of(states, bends))
      effects.push_back({.kind = "link_bending", .joint = joint, .settings = {}, .form = "masses"});
  }
  return effects;
}

std::string LinkBendingLaw::formula(const Effect& effect, const Robot& robot) const {
  const std::string joint = std::to_string(effect.joint + 1);
  if (!of_parts(effect)) {
    return write_equations(effect, robot,
                           {{"tilt_x" + joint, {{0, "M_x" + joint}}}, {"tilt_y" + joint, {{1, "M_y" + joint}}}});
  }
  std::vector<Equation> equations;
  for (const char* const axis : {"x", "y"}) {
    Equation& equation = equations.emplace_back(Equation{std::string("tilt_") + axis + joint, {}});
    for (const WeightPart& part : kept_parts(effect)) {
      equation.terms.push_back({equation.terms.size(), std::string("lever_") + axis + '_' + name_of(part)});
    }
  }
  return write_equations(effect, robot, equations);
}

std::string LinkBendingLaw::diagnosis(const Effect& effect, const Robot& /*robot*/) const {
  const std::string joint = std::to_string(effect.joint + 1);
  if (!of_parts(effect)) {
    return "The axis of joint " + joint + " tilts by " + angle_text(effect.value(0)) + " about its x and " +
           angle_text(effect.value(1)) +
           " about its y per Nm of gravity's moment there: its bearing or the link before it bends.";
  }
  double moments_rad = 0.0, masses_rad_per_m = 0.0;
  const std::vector<WeightPart> parts = kept_parts(effect);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    (parts[i].axis < 3 ? moments_rad : masses_rad_per_m) += std::abs(effect.value(i));
  }
  const std::string amount = moments_rad > 0 ? angle_text(moments_rad) : angle_text(masses_rad_per_m) + " a metre";
  return "What holds joint " + joint + " tilts under the weight of the arm, whose masses are not known: by up to " +
         amount + '.';
}

std::string LinkBendingLaw::implausibility(const Effect& effect) const {
  constexpr double kMost_rad = 3e-3;  // stands and bolted bases give way by a tenth of it
  if (!of_parts(effect)) return {};
  const auto tilts_too_far = [](double value) { return std::abs(value) > kMost_rad; };
  return std::ranges::any_of(effect.values, tilts_too_far) ? "no base gives way so far (> 3 mrad)" : "";
}

std::vector<std::string> LinkBendingLaw::settings() const {
  std::vector<std::string> names;
  for (int link = 0; link < kMaxJoints; ++link) {
    for (int axis = 0; axis < 4; ++axis) names.push_back(std::string(kKeep) + name_of({link, axis}));
  }
  return names;
}

void LinkBendingLaw::append_symbolic_motions(SymbolicWriter& writer) const {
  const int joint = writer.effect.joint;
  const auto append = [&](int coefficient, const SymbolicVector& moment) {
    for (int axis = 0; axis < 2; ++axis)
      writer.append(coefficient, joint, 3 + axis, moment[static_cast<std::size_t>(axis)]);
  };
  if (of_parts(writer.effect)) {
    int coefficient = 0;
    for (const WeightPart& part : kept_parts(writer.effect))
      append(coefficient++, lever_moment(writer.state, joint, part));
    return;
  }
  const SymbolicVector moment = gravity_moment(writer.state, joint);
  for (int axis = 0; axis < 2; ++axis) writer.append(axis, joint, 3 + axis, moment[static_cast<std::size_t>(axis)]);
}

}  // namespace

const EffectLaw& geometry_law() {
  static const GeometryLaw law;
  return law;
}

const EffectLaw& link_bending_law() {
  static const LinkBendingLaw law;
  return law;
}

}  // namespace demecal::inline effects
