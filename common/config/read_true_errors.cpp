
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/scenario_file.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "simulation/scenario.hpp"
#include "simulation/truth.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

constexpr std::int64_t kHighestOrder = 1000;

/// Collects the keys that an item of a list of errors may have: plain ones, and stems with a unit.
class ErrorKeys {
 public:
  explicit ErrorKeys(int joints) : joints_(joints) {}

  std::vector<std::string> all() const {
    std::vector<std::string> keys = plain_;
    keys.emplace_back("joint");
    for (std::string& key : keys_with_units(stems_)) keys.push_back(std::move(key));
    return keys;
  }

  int joints() const { return joints_; }
  void number(const char* key, double) { plain_.emplace_back(key); }
  void optional(const char* key, double) { plain_.emplace_back(key); }
  void positive(const char* key, double) { plain_.emplace_back(key); }
  void order(const char* key, int) { plain_.emplace_back(key); }
  void joint(const char* key, int) { plain_.emplace_back(key); }
  void formula(const char* key, const Tree&, const VariableNames&) { plain_.emplace_back(key); }
  void per_load(const char* revolute, const char* prismatic, double) {
    plain_.emplace_back(revolute);
    plain_.emplace_back(prismatic);
  }
  void motion(const char* stem, double) { stems_.emplace_back(stem); }
  void optional_motion(const char* stem, double) { stems_.emplace_back(stem); }
  void tilts(const char* stem, const Eigen::Vector2d&) { stems_.emplace_back(stem); }

 private:
  int joints_;
  std::vector<std::string> plain_, stems_;
};

/// Reads the fields of an error from an item of a list.
class ErrorReader {
 public:
  ErrorReader(const YamlNode& item, const Chain& chain, int joint)
      : item_(item), chain_(chain), type_(chain.joints[static_cast<std::size_t>(joint)].type) {}

  int joints() const { return chain_.size(); }
  void number(const char* key, double& value) const { value = item_.at(key).number(); }
  void optional(const char* key, double& value) const { value = item_.find(key) ? item_.at(key).number() : 0.0; }
  void positive(const char* key, double& value) const { value = item_.at(key).positive(); }
  void order(const char* key, int& value) const {
    const YamlNode* order = item_.find(key);
    value = order ? static_cast<int>(order->whole_number(1, kHighestOrder)) : 1;
  }
  void joint(const char* key, int& value) const { value = joint_at(item_, key, chain_); }
  void formula(const char* key, Tree& tree, const VariableNames& names) const {
    const YamlNode& formula = item_.at(key);
    try {
      tree = parse(formula.text(), names);
    } catch (const InputError& fault) {
      formula.fail("is no formula: " + fault.rule());
    }
  }
  void per_load(const char* revolute, const char* prismatic, double& value) const {
    value = item_.at(type_ == JointType::revolute ? revolute : prismatic).number();
  }
  void motion(const char* stem, double& value) const { value = measured_at(item_, stem, type_); }
  void optional_motion(const char* stem, double& value) const { value = measured_or_zero(item_, stem, type_); }
  void tilts(const char* stem, Eigen::Vector2d& angles) const {
    const auto measured = find_measured(item_, stem, JointType::revolute);
    if (measured) angles = measured->to_inside(1.0) * measured->node->vector2();
  }

 private:
  const YamlNode& item_;
  const Chain& chain_;
  JointType type_;
};

template <typename Error>
void read_errors(const YamlNode& list, const Chain& chain, std::vector<Error>& errors) {
  for (const YamlNode& item : list.list()) {
    Error error;
    ErrorKeys keys(chain.size());
    error.visit_fields(keys);
    item.with_keys(keys.all());
    error.joint = joint_at(item, "joint", chain);
    error.visit_fields(ErrorReader(item, chain, error.joint));
    errors.push_back(std::move(error));
  }
}

/// An item names the parameters of its link that are wrong.
void read_errors(const YamlNode& list, const Chain& chain, std::vector<GeometryError>& errors) {
  std::vector<std::string> keys{"joint"};
  for (std::string& key : keys_with_units({"theta", "d", "a", "alpha", "beta"})) keys.push_back(std::move(key));
  for (const YamlNode& item : list.list()) {
    item.with_keys(keys);
    const int joint = joint_at(item, "joint", chain);
    const auto add = [&](const std::string& stem, LinkParameter parameter, JointType unit) {
      if (const auto value = find_measured(item, stem, unit)) errors.push_back({joint, parameter, value->number()});
    };
    add("theta", LinkParameter::theta, JointType::revolute);
    add("d", LinkParameter::d, JointType::prismatic);
    add("a", LinkParameter::a, JointType::prismatic);
    add("alpha", LinkParameter::alpha, JointType::revolute);
    add("beta", LinkParameter::beta, JointType::revolute);
  }
}

void read_instrument_errors(const YamlNode& errors, TrueErrors& truth) {
  if (const YamlNode* tool = errors.find(kToolErrorKey)) truth.tool_error_m = metres(1.0) * tool->vector3();
  if (const YamlNode* scale = errors.find(kSensorScaleKey)) {
    truth.sensor_scale.share = scale->with_keys({"share"}).at("share").number(-0.5, 0.5);
  }
  const YamlNode* drift = errors.find(kDriftKey);
  if (!drift) return;
  drift->with_keys({"mm_per_s", "deg_per_s"});
  if (const YamlNode* moved = drift->find("mm_per_s")) truth.drift.metres_per_s = metres(1.0) * moved->vector3();
  if (const YamlNode* turned = drift->find("deg_per_s")) truth.drift.rad_per_s = radians(1.0) * turned->vector3();
}

}  // namespace

void read_true_errors(const YamlNode& errors, Scenario& scenario) {
  std::vector<std::string> keys;
  visit_joint_errors(scenario, [&](const char* key, const auto& /*list*/) { keys.emplace_back(key); });
  for (const std::string_view key : {kDriftKey, kSensorScaleKey, kToolErrorKey}) keys.emplace_back(key);
  errors.with_keys(keys);
  const Chain& chain = scenario.robot.chain;
  visit_joint_errors(scenario, [&](const char* key, auto& list) {
    if (const YamlNode* items = errors.find(key)) read_errors(*items, chain, list);
  });
  read_instrument_errors(errors, scenario);
}

}  // namespace demecal::inline config
