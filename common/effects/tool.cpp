#include "effects/laws.hpp"
#include "effects/rigid_words.hpp"

namespace demecal {
namespace {

/// The tool's place on the flange. Forms: `position`, three shifts; `pose`, also three turns about the flange's origin.
class Tool final : public EffectLaw {
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
    const std::string turned = count(effect) == 6 ? ", turned by " + triple_words(effect, 3, 1e3, "mrad") : "";
    return "The tool sits elsewhere on the flange than the model has it: by " + triple_words(effect, 0, 1e3, "mm") +
           turned + '.';
  }
  std::vector<std::string> forms() const override { return {"position", "pose"}; }
  bool of_joint() const override { return false; }

 private:
  static int count(const Effect& effect) { return effect.form == "pose" ? 6 : 3; }
};

}  // namespace

const EffectLaw& tool_law() {
  static const Tool law;
  return law;
}

}  // namespace demecal
