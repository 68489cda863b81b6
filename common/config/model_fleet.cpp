#include <string>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
namespace {

FleetNumber read_number(const YamlNode& node) {
  node.with_keys({"name", "mean", "standard_error", "spread"});
  return {node.at("name").text(), node.at("mean").number(), node.at("standard_error").non_negative(),
          node.at("spread").non_negative()};
}

FleetCurve read_curve(const YamlNode& node, const Chain& chain) {
  node.with_keys({"joint", "wave_deviations_rad"});
  FleetCurve curve{joint_at(node, "joint", chain), {}};
  for (const YamlNode& deviation : node.at("wave_deviations_rad").list())
    curve.wave_deviations_rad.push_back(deviation.non_negative());
  return curve;
}

}  // namespace

std::string fleet_text(const CalibratedModel& model) {
  if (!model.fleet) return {};
  std::string text =
      "# No calibrated robot: the mean of these, and how they are spread about it, in the units that names state "
      "(effects: SI)\nfleet:\n  robots:\n";
  for (const FleetMember& one : model.fleet->robots)
    text += "    - {file: " + yaml_text(one.file) + ", job: " + yaml_text(one.job) +
            ", data: " + yaml_text(one.data_name) + ", data_sha256: " + yaml_text(one.data_sha256) + "}\n";
  text += model.fleet->numbers.empty() ? "  numbers: []\n" : "  numbers:\n";
  for (const FleetNumber& one : model.fleet->numbers)
    text += "    - {name: " + yaml_text(one.name) + ", mean: " + number_text(one.mean) +
            ", standard_error: " + number_text(one.standard_error) + ", spread: " + number_text(one.spread) + "}\n";
  text += model.fleet->curves.empty() ? "  curves: []\n" : "  curves:\n";
  for (const FleetCurve& one : model.fleet->curves)
    text += "    - {joint: " + std::to_string(one.joint + 1) +
            ", wave_deviations_rad: " + yaml_numbers(one.wave_deviations_rad) + "}\n";
  return text;
}

void read_fleet(const YamlNode& file, CalibratedModel& model) {
  const YamlNode* node = file.find("fleet");
  if (node == nullptr) return;
  node->with_keys({"robots", "numbers", "curves"});
  FleetOrigin fleet;
  for (const YamlNode& one : node->at("robots").list()) {
    one.with_keys({"file", "job", "data", "data_sha256"});
    fleet.robots.push_back(
        {one.at("file").text(), one.at("job").text(), one.at("data").text(), one.at("data_sha256").text()});
  }
  for (const YamlNode& one : node->at("numbers").list()) fleet.numbers.push_back(read_number(one));
  for (const YamlNode& one : node->at("curves").list()) fleet.curves.push_back(read_curve(one, model.nominal.chain));
  if (!model.posterior || model.posterior->ids.size() != fleet.numbers.size())
    node->fail("", "must have the numbers of the posterior, in its order: make the file anew by `demecal fleet`");
  model.fleet = std::move(fleet);
}

}  // namespace demecal::inline config
