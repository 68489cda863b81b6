#include "config/model_file.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "config/job_file.hpp"
#include "data/certificate_fields.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
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

void read_link_numbers(const YamlNode& node, Joint& joint) {
  node.with_keys({"theta_offset_deg", "d_mm", "a_mm", "alpha_deg", "beta_deg"});
  joint.theta_rad = radians(node.at("theta_offset_deg").number());
  joint.d_m = metres(node.at("d_mm").number());
  joint.a_m = metres(node.at("a_mm").number());
  joint.alpha_rad = radians(node.at("alpha_deg").number());
  joint.beta_rad = radians(node.at("beta_deg").number());
}

/// Estimates are for people: nothing but their keys is looked at.
void check_estimates(const YamlNode& list) {
  for (const YamlNode& entry : list.list()) entry.with_keys({"name", "nominal", "value", "standard_error"});
}

std::string stations_text(const std::vector<Station>& stations) {
  std::string text = stations.empty() ? "" : "stations:\n";
  for (const Station& station : stations)
    text += "  - {name: " + yaml_text(station.name) + ", data_sha256: " + yaml_text(station.sha256) +
            ", first_from_own: " + rigid_text(station.first_from_own) + "}\n";
  return text;
}

void read_stations(const YamlNode* list, std::vector<Station>& stations) {
  if (!list) return;
  for (const YamlNode& one : list->list()) {
    one.with_keys({"name", "data_sha256", "first_from_own"});
    stations.push_back({one.at("name").text(), one.at("data_sha256").text(), read_rigid(one.at("first_from_own"))});
  }
}

}  // namespace

std::string model_text(const CalibratedModel& model) {
  std::ostringstream text;
  text << "# Where the real robot goes: sensor_from_base * chain(q + g(q)) * tool, and what the effects move besides; "
          "g is in\n"
       << "# rad of theta in rad, coefficients of effects are in SI units\n"
       << "demecal_model: 1\njob: " << yaml_text(model.job) << "\nversion: " << yaml_text(model.version)
       << "\nmethod: " << to_string(model.method) << "\nseed: " << model.seed
       << "\ndata: {name: " << yaml_text(model.data_name) << ", sha256: " << yaml_text(model.data_sha256)
       << (model.approach_recorded ? "" : ", approach_recorded: false")
       << (model.of_one_contact ? ", one_contact: true" : "")
       << (model.data_findings.empty() ? "" : ", findings: " + yaml_list(model.data_findings)) << "}\n";
  text << "robot:\n" << robot_text(model.nominal, 2);
  text << "declared: " << yaml_list(model.declared.words()) << '\n';
  text << "base: " << rigid_text(model.robot.sensor_from_base) << "\ntools:\n";
  for (const auto& [target, tool] : model.robot.tools) {
    text << "  - {" << (target.empty() ? "" : "target: " + yaml_text(target) + ", ") << "pose: " << rigid_text(tool)
         << "}\n";
  }
  text << stations_text(model.stations) << "links:\n";
  for (const Joint& joint : model.robot.chain.joints) text << "  - " << link_text(joint) << '\n';
  if (!model.estimates.empty()) text << "estimates:\n";
  for (const ParameterEstimate& estimate : model.estimates) {
    if (estimate.id.kind == ParameterId::Kind::effect) continue;  // effects say their own below
    text << "  - " << estimate_text(estimate) << '\n';
  }
  text << effects_text(model.robot.effects, model.nominal) << functions_text(model) << corrections_text(model)
       << posterior_text(model) << fleet_text(model) << prediction_text(model) << certificate_text(model.certificate);
  return text.str();
}

CalibratedModel load_model(const std::filesystem::path& path) {
  return read_model(read_file(path), path.string());
}

CalibratedModel read_model(const std::string& text, const std::string& path) {
  const YamlNode file = parse_yaml(text, path).with_version("model", 1);
  file.with_keys({"demecal_model",
                  "job",
                  "version",
                  "method",
                  "seed",
                  "data",
                  "robot",
                  "declared",
                  "base",
                  "tools",
                  "stations",
                  "links",
                  "estimates",
                  "effects",
                  "shared_functions",
                  "corrections",
                  "measured_ranges",
                  "measured_gaps",
                  "pose_counts",
                  "pose_marks",
                  "measured_payload_kg",
                  "measured_temperature_celsius",
                  "posterior",
                  "fleet",
                  "prediction_interval",
                  "certificate"});
  CalibratedModel model;
  model.job = file.at("job").text();
  model.version = file.at("version").text();
  model.method = file.at("method").one_of<Method>({{"direct", Method::direct},
                                                   {"distal", Method::distal},
                                                   {"diagnose", Method::diagnose},
                                                   {"structural", Method::structural}});
  model.seed = file.at("seed").seed();
  const YamlNode& data = file.at("data").with_keys({"name", "sha256", "approach_recorded", "one_contact", "findings"});
  model.data_name = data.at("name").text();
  model.data_sha256 = data.at("sha256").text();
  if (const YamlNode* recorded = data.find("approach_recorded")) model.approach_recorded = recorded->boolean();
  if (const YamlNode* one_contact = data.find("one_contact")) model.of_one_contact = one_contact->boolean();
  if (const YamlNode* findings = data.find("findings"))
    for (const YamlNode& kind : findings->list()) model.data_findings.push_back(kind.text());
  model.nominal = read_robot(file.at("robot"));
  model.robot.chain = model.nominal.chain;
  model.declared = read_declared(file.at("declared"));
  const std::vector<YamlNode>& links = file.at("links").list(model.nominal.chain.joints.size());
  for (std::size_t i = 0; i < links.size(); ++i) read_link_numbers(links[i], model.robot.chain.joints[i]);
  model.robot.sensor_from_base = read_rigid(file.at("base"));
  for (const YamlNode& tool : file.at("tools").list()) {
    const YamlNode* target = tool.with_keys({"target", "pose"}).find("target");
    model.robot.tools[target ? target->text() : ""] = read_rigid(tool.at("pose"));
  }
  read_stations(file.find("stations"), model.stations);
  if (const YamlNode* estimates = file.find("estimates")) check_estimates(*estimates);
  model.functions = read_functions(file.find("shared_functions"));
  read_corrections(file.at("corrections"), model);
  model.robot.effects = read_effects(file.at("effects"), model.nominal);
  model.robot.described = model.nominal;
  read_posterior(file, model);
  read_fleet(file, model);
  read_prediction(file, model);
  if (const YamlNode* certificate = file.find("certificate")) model.certificate = read_certificate(*certificate);
  return model;
}

}  // namespace demecal::inline config
