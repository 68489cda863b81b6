#include "effects/joint_words.hpp"
#include "effects/laws.hpp"
#include "effects/rigid_words.hpp"

namespace demecal {
namespace {

constexpr double kSecondsPerHour = 3600.0;

/// The base creeps through the instrument's frame, evenly in time.
class Drift final : public EffectLaw {
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
                                 "(t - " + number_words(effect.setting("reference_time_s")) + " s)");
  }
  std::string diagnosis(const Effect& effect, const Robot& /*robot*/) const override {
    return "The base creeps through the instrument's frame by " +
           triple_words(effect, 0, 1e3 * kSecondsPerHour, "mm/h") + " and turns by " +
           triple_words(effect, 3, 1e3 * kSecondsPerHour, "mrad/h") + ": its mount or the instrument's moves.";
  }
  std::vector<std::string> settings() const override { return {"reference_time_s"}; }
  bool of_joint() const override { return false; }
};

}  // namespace

const EffectLaw& drift_law() {
  static const Drift law;
  return law;
}

}  // namespace demecal
