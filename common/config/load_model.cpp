#include <cmath>

#include "config/load_robot.hpp"
#include "config/model_text.hpp"
#include "config/posterior_text.hpp"
#include "config/prediction_text.hpp"
#include "config/read_declared.hpp"
#include "config/read_effects.hpp"
#include "config/read_yaml.hpp"
#include "errors/input_error.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

Eigen::Isometry3d read_rigid(const YamlNode& node) {
  node.with_keys({"position_mm", "quaternion_wxyz"});
  const YamlNode& turn = node.at("quaternion_wxyz");
  const std::vector<double> q = turn.numbers();
  if (q.size() != 4) turn.fail("", "must have 4 numbers");
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  if (std::abs(quaternion.norm() - 1.0) > 1e-6) turn.fail("", "must be a unit quaternion");
  Eigen::Isometry3d pose(quaternion.normalized());
  pose.translation() = metres(1.0) * node.at("position_mm").vector3();
  return pose;
}

void read_link(const YamlNode& node, Joint& joint) {
  node.with_keys({"theta_offset_deg", "d_mm", "a_mm", "alpha_deg", "beta_deg"});
  joint.theta_rad = radians(node.at("theta_offset_deg").number());
  joint.d_m = metres(node.at("d_mm").number());
  joint.a_m = metres(node.at("a_mm").number());
  joint.alpha_rad = radians(node.at("alpha_deg").number());
  joint.beta_rad = radians(node.at("beta_deg").number());
}

Tree read_formula(const YamlNode& node, std::span<const SharedFunction> functions = {}) {
  try {
    return parse(node.text(), theta_only(), functions);
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

/// For people: that it is what the expression says is all that is asked of it.
void check_calls(const YamlNode& node, const Tree& formula, const CalibratedModel& model) {
  if (!model.functions) node.fail("calls functions that the model does not define");
  if (depth(formula) > kDeepestFolded) node.fail("stands for a formula that is too deep for calls");
  if (in_order(read_formula(node, *model.functions)) != in_order(formula))
    node.fail("is not the formula that `expression` is");
}

KnownFunctions read_functions(const YamlNode* node) {
  if (node == nullptr) return std::nullopt;
  std::vector<SharedFunction> functions;
  for (const YamlNode& entry : node->list()) {
    entry.with_keys({"definition", "joints"});
    const YamlNode& definition = entry.at("definition");
    if (functions.size() == kMostSharedFunctions) entry.fail("", "is one function too many");
    try {
      functions.push_back(parse_definition(definition.text(), functions.size()));
    } catch (const InputError& error) {
      definition.fail(error.what());
    }
  }
  return functions;
}

/// Estimates are for people: nothing but their keys is looked at.
void check_estimates(const YamlNode* list) {
  if (list == nullptr) return;
  for (const YamlNode& entry : list->list()) entry.with_keys({"name", "nominal", "value", "standard_error"});
}

/// Reads one entry of `corrections` into summary and correction.
JointCorrection read_correction(const YamlNode& node, const CalibratedModel& model, JointSummary& summary) {
  node.with_keys({"joint", "expression", "with_functions", "range_rad", "branch_centre_rad", "bound_rad",
                  "discontinuities_rad", "note"});
  if (const YamlNode* note = node.find("note")) summary.note = note->text();
  const Tree formula = read_formula(node.at("expression"));
  summary.kept = formula != neutral_tree();
  if (const YamlNode* calls = node.find("with_functions")) check_calls(*calls, formula, model);
  if (!summary.kept) return {};
  if (const YamlNode* bound = node.find("bound_rad")) summary.bound_rad = bound->non_negative();
  if (const YamlNode* jumps = node.find("discontinuities_rad")) summary.discontinuities_rad = jumps->numbers();
  AngleBranch branch;
  if (const YamlNode* centre = node.find("branch_centre_rad")) branch = {true, centre->number()};
  const auto [lower, upper] = node.at("range_rad").range();
  return {formula, branch, {lower, upper}};
}

void read_corrections(const YamlNode& node, CalibratedModel& model) {
  const int joints = model.robot.chain.size();
  model.robot.corrections.assign(static_cast<std::size_t>(joints), {});
  model.joints.resize(static_cast<std::size_t>(joints));
  for (int joint = 0; joint < joints; ++joint) model.joints[static_cast<std::size_t>(joint)].joint = joint;
  for (const YamlNode& entry : node.list()) {
    const auto joint = static_cast<std::size_t>(entry.at("joint").whole_number(1, joints) - 1);
    model.robot.corrections[joint] = read_correction(entry, model, model.joints[joint]);
  }
}

}  // namespace

CalibratedModel load_model(const std::filesystem::path& path) {
  const YamlNode file = read_yaml(path).of_version("model", 1);
  file.with_keys({"demecal_model", "job", "version", "method", "seed", "data", "robot", "declared", "base", "tools",
                  "links", "estimates", "effects", "shared_functions", "corrections", "measured_ranges", "posterior",
                  "prediction_interval"});
  CalibratedModel model;
  model.job = file.at("job").text();
  model.version = file.at("version").text();
  model.method = file.at("method").one_of<Method>({{"direct", Method::direct},
                                                   {"distal", Method::distal},
                                                   {"diagnose", Method::diagnose},
                                                   {"structural", Method::structural}});
  model.seed = file.at("seed").seed();
  const YamlNode& data = file.at("data").with_keys({"name", "sha256"});
  model.data_name = data.at("name").text();
  model.data_sha256 = data.at("sha256").text();
  model.nominal = robot_from(file.at("robot"));
  model.declared = read_declared(file.at("declared"));
  model.robot.chain = model.nominal.chain;
  const std::vector<YamlNode>& links = file.at("links").list(model.nominal.chain.joints.size());
  for (std::size_t i = 0; i < links.size(); ++i) read_link(links[i], model.robot.chain.joints[i]);
  model.robot.sensor_from_base = read_rigid(file.at("base"));
  for (const YamlNode& tool : file.at("tools").list()) {
    tool.with_keys({"target", "pose"});
    const YamlNode* target = tool.find("target");
    model.robot.tools[target ? target->text() : ""] = read_rigid(tool.at("pose"));
  }
  check_estimates(file.find("estimates"));
  model.functions = read_functions(file.find("shared_functions"));
  read_corrections(file.at("corrections"), model);
  model.robot.effects = read_effects(file.at("effects"), model.nominal);
  model.robot.described = model.nominal;
  read_posterior(file, model);
  read_prediction(file, model);
  return model;
}

}  // namespace demecal
