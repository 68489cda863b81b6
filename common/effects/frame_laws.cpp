// Where base, tool and instrument stand: registration, tool, drift, and the instrument's scale.
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "effects/law_terms.hpp"
#include "effects/symbolic_state.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline effects {
namespace {

/// The base's place in the instrument's frame: six motions about the frame of the measurements.
class RegistrationLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "registration"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return rigid_labels(6);
  }
  void unit_motions(const Effect& /*effect*/, const Robot& /*robot*/, const ArmState& /*state*/,
                    std::vector<UnitMotion>& motions) const override {
    append_rigid_motions(kSensorPlace, 6, 1.0, motions);
  }
  std::vector<Effect> proposals(const Robot& /*robot*/, const Evidence& /*evidence*/) const override {
    return {{.kind = "registration"}};
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_rigid_equations(effect, robot, 6, "dbase_");
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The base stands elsewhere in the instrument's frame than the model has it: by " +
           triple_text(effect, 0, 1e3, "mm") + ", turned by " + triple_text(effect, 3, 1e3, "mrad") + '.';
  }
  Subject subject() const override { return Subject::instrument; }
  void append_symbolic_motions(SymbolicWriter& writer) const override { writer.append_rigid(kSensorPlace, 6); }
};

/// The tool's place on the flange. Forms: `position`, three shifts; `pose`, also three turns about the flange's origin.
class ToolLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "tool"; }
  std::vector<CoefficientLabel> coefficients(const Effect& effect, const Robot& /*robot*/) const override {
    return rigid_labels(count(effect));
  }
  void unit_motions(const Effect& effect, const Robot& robot, const ArmState& /*state*/,
                    std::vector<UnitMotion>& motions) const override {
    append_rigid_motions(robot.chain.size(), count(effect), 1.0, motions);
  }
  std::vector<Effect> proposals(const Robot& /*robot*/, const Evidence& evidence) const override {
    return {{.kind = "tool", .joint = -1, .settings = {}, .form = evidence.orientation ? "pose" : "position"}};
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_rigid_equations(effect, robot, count(effect), "dtool_");
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    const std::string turned = count(effect) == 6 ? ", turned by " + triple_text(effect, 3, 1e3, "mrad") : "";
    return "The tool sits elsewhere on the flange than the model has it: by " + triple_text(effect, 0, 1e3, "mm") +
           turned + '.';
  }
  std::vector<std::string> forms() const override { return {"position", "pose"}; }
  Subject subject() const override { return Subject::tool; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    writer.append_rigid(writer.robot().chain.size(), count(writer.effect));
  }

 private:
  static int count(const Effect& effect) { return effect.form == "pose" ? 6 : 3; }
};

constexpr double kSecondsPerHour = 3600.0;

/// The base creeps through the instrument's frame, evenly in time.
class DriftLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "drift"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return rigid_labels(6, "_per_s", "/s");
  }
  void unit_motions(const Effect& effect, const Robot& /*robot*/, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    if (!state.stop.time_s) return;
    append_rigid_motions(kSensorPlace, 6, *state.stop.time_s - effect.setting("reference_time_s"), motions);
  }
  std::vector<Effect> proposals(const Robot& /*robot*/, const Evidence& evidence) const override {
    if (!evidence.time) return {};
    return {{.kind = "drift", .joint = -1, .settings = {{"reference_time_s", evidence.mean_time_s}}}};
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {.time = true}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_rigid_equations(effect, robot, 6, "dbase_",
                                 "(t - " + rounded_text(effect.setting("reference_time_s")) + " s)");
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The base creeps through the instrument's frame by " +
           triple_text(effect, 0, 1e3 * kSecondsPerHour, "mm/h") + " and turns by " +
           triple_text(effect, 3, 1e3 * kSecondsPerHour, "mrad/h") + ": its mount or the instrument's moves.";
  }
  std::vector<std::string> settings() const override { return {"reference_time_s"}; }
  Subject subject() const override { return Subject::instrument; }
  Circumstance prerequisite() const override { return Circumstance::time; }
};

/// An instrument whose metre is not a metre: it reads every point (1 + share) times as far from its origin.
class SensorScaleLaw final : public EffectLaw {
 public:
  std::string_view kind() const override { return "sensor_scale"; }
  std::vector<CoefficientLabel> coefficients(const Effect& /*effect*/, const Robot& /*robot*/) const override {
    return {{"share", "1"}};
  }
  void unit_motions(const Effect& /*effect*/, const Robot& /*robot*/, const ArmState& state,
                    std::vector<UnitMotion>& motions) const override {
    for (int axis = 0; axis < 3; ++axis) motions.push_back({0, kSensorPlace, axis, state.tool_in_sensor_m[axis]});
  }
  std::vector<Effect> proposals(const Robot& /*robot*/, const Evidence& /*evidence*/) const override {
    return {{.kind = "sensor_scale"}};
  }
  Needs needs(const Effect& /*effect*/, const Robot& /*robot*/) const override { return {}; }
  std::string formula(const Effect& effect, const Robot& robot) const override {
    return write_equations(effect, robot, {{"dp", {{0, "p"}}}});
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The instrument reads lengths " + share_text(std::abs(effect.value(0))) +
           (effect.value(0) < 0.0 ? " too short." : " too long.");
  }
  Subject subject() const override { return Subject::instrument; }
  void append_symbolic_motions(SymbolicWriter& writer) const override {
    for (int axis = 0; axis < 3; ++axis) {
      writer.append(0, kSensorPlace, axis, writer.state.tool_in_sensor[static_cast<std::size_t>(axis)]);
    }
  }
};

}  // namespace

const EffectLaw& registration_law() {
  static const RegistrationLaw law;
  return law;
}

const EffectLaw& tool_law() {
  static const ToolLaw law;
  return law;
}

const EffectLaw& drift_law() {
  static const DriftLaw law;
  return law;
}

const EffectLaw& sensor_scale_law() {
  static const SensorScaleLaw law;
  return law;
}

}  // namespace demecal::inline effects
