#include <cmath>

#include "effects/joint_words.hpp"
#include "effects/laws.hpp"

namespace demecal {
namespace {

/// An instrument whose metre is not a metre: it reads every point (1 + share) times as far from its origin.
class SensorScale final : public EffectLaw {
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
    return "The instrument reads lengths " + share_words(std::abs(effect.value(0))) +
           (effect.value(0) < 0.0 ? " too short." : " too long.");
  }
  bool of_joint() const override { return false; }
};

}  // namespace

const EffectLaw& sensor_scale_law() {
  static const SensorScale law;
  return law;
}

}  // namespace demecal
