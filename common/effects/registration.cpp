#include "effects/laws.hpp"
#include "effects/rigid_words.hpp"

namespace demecal {
namespace {

/// The base's place in the instrument's frame: six motions about the frame of the measurements.
class Registration final : public EffectLaw {
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
           triple_words(effect, 0, 1e3, "mm") + ", turned by " + triple_words(effect, 3, 1e3, "mrad") + '.';
  }
  bool of_joint() const override { return false; }
};

}  // namespace

const EffectLaw& registration_law() {
  static const Registration law;
  return law;
}

}  // namespace demecal
