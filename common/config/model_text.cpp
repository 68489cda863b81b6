#include "config/model_text.hpp"

#include <cmath>
#include <sstream>

#include "calibration/shared_functions.hpp"
#include "config/effect_text.hpp"
#include "config/posterior_text.hpp"
#include "config/prediction_text.hpp"
#include "config/robot_text.hpp"
#include "config/yaml_text.hpp"
#include "expression/text.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

std::string rigid_text(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  const double quaternion[] = {turn.w(), turn.x(), turn.y(), turn.z()};
  return "{position_mm: " + yaml_mm(pose.translation()) + ", quaternion_wxyz: " + yaml_numbers(quaternion) + "}";
}

std::string estimate_text(const ParameterEstimate& estimate) {
  const auto border = [&](double value) {
    return estimate.id.is_angle() ? degrees_text(value) : millimetres_text(value);
  };
  return "{name: " + yaml_text(estimate.id.name()) + ", nominal: " + border(estimate.nominal) +
         ", value: " + border(estimate.value) + ", standard_error: " + border(estimate.standard_error) + "}";
}

std::string link_text(const Joint& joint) {
  return "{theta_offset_deg: " + degrees_text(joint.theta_rad) + ", d_mm: " + millimetres_text(joint.d_m) +
         ", a_mm: " + millimetres_text(joint.a_m) + ", alpha_deg: " + degrees_text(joint.alpha_rad) +
         ", beta_deg: " + degrees_text(joint.beta_rad) + "}";
}

std::string functions_text(const CalibratedModel& model) {
  if (!model.functions) return {};
  std::ostringstream text;
  text << "shared_functions:" << (model.functions->empty() ? " []\n" : "\n");
  for (std::size_t i = 0; i < model.functions->size(); ++i) {
    text << "  - {definition: " << yaml_text(definition_text((*model.functions)[i], i)) << ", joints: [";
    const std::vector<int> joints = joints_calling(model.robot, *model.functions, i);
    for (std::size_t k = 0; k < joints.size(); ++k) text << (k == 0 ? "" : ", ") << joints[k] + 1;
    text << "]}\n";
  }
  return text.str();
}

std::string correction_text(const JointSummary& summary, const JointCorrection& correction,
                            const KnownFunctions& functions) {
  std::ostringstream text;
  text << "  - joint: " << summary.joint + 1 << '\n';
  if (!summary.kept) {
    text << "    expression: theta-theta\n";
    if (!summary.note.empty()) text << "    note: " << yaml_text(summary.note) << '\n';
    return text.str();
  }
  const double range[] = {correction.range_rad().lower, correction.range_rad().upper};
  text << "    expression: " << yaml_text(to_string(correction.formula())) << '\n';
  if (const FoldedFormula calling = folded_correction(correction, functions); !calling.calls.empty())
    text << "    with_functions: " << yaml_text(to_string(calling)) << '\n';
  text << "    range_rad: " << yaml_numbers(range) << '\n';
  if (correction.branch().wraps)
    text << "    branch_centre_rad: " << number_text(correction.branch().centre_rad) << '\n';
  if (std::isfinite(summary.bound_rad)) text << "    bound_rad: " << number_text(summary.bound_rad) << '\n';
  text << "    discontinuities_rad: " << yaml_numbers(summary.discontinuities_rad) << '\n';
  return text.str();
}

}  // namespace

std::string model_text(const CalibratedModel& model) {
  std::ostringstream text;
  text << "# Where the real robot goes: sensor_from_base * chain(q + g(q)) * tool, and what the effects move besides; "
          "g is in\n"
       << "# rad of theta in rad, coefficients of effects are in SI units\n"
       << "demecal_model: 1\njob: " << yaml_text(model.job) << "\nversion: " << yaml_text(model.version)
       << "\nmethod: " << to_string(model.method) << "\nseed: " << model.seed
       << "\ndata: {name: " << yaml_text(model.data_name) << ", sha256: " << yaml_text(model.data_sha256) << "}\n";
  text << "robot:\n" << robot_text(model.nominal, 2);
  text << "declared: " << yaml_list(model.declared.words()) << '\n';
  text << "base: " << rigid_text(model.robot.sensor_from_base) << "\ntools:\n";
  for (const auto& [target, tool] : model.robot.tools) {
    text << "  - {" << (target.empty() ? "" : "target: " + yaml_text(target) + ", ") << "pose: " << rigid_text(tool)
         << "}\n";
  }
  text << "links:\n";
  for (const Joint& joint : model.robot.chain.joints) text << "  - " << link_text(joint) << '\n';
  if (!model.estimates.empty()) text << "estimates:\n";
  for (const ParameterEstimate& estimate : model.estimates) {
    if (estimate.id.kind == ParameterId::Kind::effect) continue;  // effects say their own below
    text << "  - " << estimate_text(estimate) << '\n';
  }
  text << effects_text(model.robot.effects, model.nominal) << functions_text(model) << "corrections:\n";
  for (const JointSummary& summary : model.joints) {
    const JointCorrection& correction = model.robot.corrections[static_cast<std::size_t>(summary.joint)];
    text << correction_text(summary, correction, model.functions);
  }
  text << posterior_text(model) << prediction_text(model);
  return text.str();
}

}  // namespace demecal
