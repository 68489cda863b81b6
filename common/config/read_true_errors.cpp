#include "config/scenario_file.hpp"

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

constexpr std::int64_t kHighestOrder = 1000;

/// One item of a list of joint errors.
struct Item {
  const YamlNode& node;
  int joint;
  JointType type;

  double at(const std::string& stem) const { return measured_at(node, stem, type); }
  double or_zero(const std::string& stem) const { return measured_or_zero(node, stem, type); }
  double number(std::string_view key) const { return node.at(key).number(); }
  double number_or_zero(std::string_view key) const { return node.find(key) ? number(key) : 0.0; }
  bool revolute() const { return type == JointType::revolute; }
};

/// Calls `read` with every item of the list, if there is one; items have `joint`, the plain keys, and the stems with a
/// unit.
template <typename Read>
void for_each_item(const YamlNode* list, const Chain& chain, const std::vector<std::string>& plain,
                   const std::vector<std::string>& stems, const Read& read) {
  if (!list) return;
  std::vector<std::string> keys = plain;
  keys.emplace_back("joint");
  for (std::string& key : keys_with_units(stems)) keys.push_back(std::move(key));
  for (const YamlNode& node : list->list()) {
    node.with_keys(keys);
    const int joint = joint_at(node, "joint", chain);
    read(Item{node, joint, chain.joints[static_cast<std::size_t>(joint)].type});
  }
}

Tree formula_at(const YamlNode& node, const VariableNames& names) {
  const YamlNode& formula = node.at("formula");
  try {
    return parse(formula.text(), names);
  } catch (const InputError& fault) {
    formula.fail("is no formula: " + fault.rule());
  }
}

int order_at(const YamlNode& node) {
  const YamlNode* order = node.find("order");
  return order ? static_cast<int>(order->whole_number(1, kHighestOrder)) : 1;
}

void read_geometry(const Item& item, Scenario& scenario) {
  const auto add = [&](const std::string& stem, LinkParameter parameter, JointType unit) {
    if (const auto value = find_measured(item.node, stem, unit)) {
      scenario.geometry.push_back({item.joint, parameter, value->number()});
    }
  };
  add("theta", LinkParameter::theta, JointType::revolute);
  add("d", LinkParameter::d, JointType::prismatic);
  add("a", LinkParameter::a, JointType::prismatic);
  add("alpha", LinkParameter::alpha, JointType::revolute);
  add("beta", LinkParameter::beta, JointType::revolute);
}

/// The key of a value per unit of load or warmth, by the kind of joint.
std::string_view by_type(const Item& item, std::string_view revolute, std::string_view prismatic) {
  return item.revolute() ? revolute : prismatic;
}

Eigen::Vector2d tilt_at(const Item& item, const std::string& stem) {
  const auto measured = find_measured(item.node, stem, JointType::revolute);
  if (!measured) return Eigen::Vector2d::Zero();
  return measured->to_inside(1.0) * measured->node->vector2();
}

void read_gear_errors(const YamlNode& errors, Scenario& scenario) {
  const Chain& chain = scenario.robot.chain;
  for_each_item(errors.find("joint_errors"), chain, {"formula"}, {}, [&](const Item& item) {
    scenario.joint_errors.push_back({item.joint, formula_at(item.node, theta_only())});
  });
  for_each_item(errors.find("gear_harmonic"), chain, {"ratio"}, {"cosine", "sine"}, [&](const Item& item) {
    scenario.gear_harmonics.push_back(
        {item.joint, item.node.at("ratio").positive(), item.or_zero("cosine"), item.or_zero("sine")});
  });
  for_each_item(errors.find("gain"), chain, {"share"}, {}, [&](const Item& item) {
    scenario.gains.push_back({item.joint, item.number("share")});
  });
  for_each_item(errors.find("eccentricity"), chain, {"order"}, {"cosine", "sine"}, [&](const Item& item) {
    scenario.eccentricities.push_back({item.joint, order_at(item.node), item.or_zero("cosine"), item.or_zero("sine")});
  });
  for_each_item(errors.find("coupling"), chain, {"from", "share"}, {"cosine", "sine"}, [&](const Item& item) {
    scenario.couplings.push_back({item.joint, joint_at(item.node, "from", chain), item.number_or_zero("share"),
                                  item.or_zero("cosine"), item.or_zero("sine")});
  });
  for_each_item(errors.find("symbolic"), chain, {"formula"}, {}, [&](const Item& item) {
    scenario.symbolic.push_back({item.joint, formula_at(item.node, symbolic_variables(chain.size()))});
  });
}

void read_side_and_load_errors(const YamlNode& errors, Scenario& scenario) {
  const Chain& chain = scenario.robot.chain;
  for_each_item(errors.find("backlash"), chain, {}, {"width"}, [&](const Item& item) {
    scenario.backlash.push_back({item.joint, item.at("width")});
  });
  for_each_item(errors.find("hysteresis"), chain, {"per_nm"}, {"friction"}, [&](const Item& item) {
    scenario.hysteresis.push_back({item.joint, item.at("friction"), item.number_or_zero("per_nm")});
  });
  for_each_item(errors.find("compliance"), chain, {"rad_per_nm", "m_per_n"}, {}, [&](const Item& item) {
    scenario.compliance.push_back({item.joint, item.number(by_type(item, "rad_per_nm", "m_per_n"))});
  });
  for_each_item(errors.find("link_bending"), chain, {"x_rad_per_nm", "y_rad_per_nm"}, {}, [&](const Item& item) {
    scenario.link_bending.push_back(
        {item.joint, item.number_or_zero("x_rad_per_nm"), item.number_or_zero("y_rad_per_nm")});
  });
}

void read_axis_and_thermal_errors(const YamlNode& errors, Scenario& scenario) {
  const Chain& chain = scenario.robot.chain;
  for_each_item(errors.find("geometry"), chain, {}, {"theta", "d", "a", "alpha", "beta"},
                [&](const Item& item) { read_geometry(item, scenario); });
  for_each_item(errors.find("axis_wobble"), chain, {"order"}, {"cosine", "sine"}, [&](const Item& item) {
    scenario.axis_wobble.push_back({item.joint, order_at(item.node), tilt_at(item, "cosine"), tilt_at(item, "sine")});
  });
  for_each_item(errors.find("thermal_offset"), chain, {"rad_per_kelvin", "m_per_kelvin"}, {}, [&](const Item& item) {
    scenario.thermal_offsets.push_back({item.joint, item.number(by_type(item, "rad_per_kelvin", "m_per_kelvin"))});
  });
  for_each_item(errors.find("thermal_length"), chain, {"share_per_kelvin"}, {}, [&](const Item& item) {
    scenario.thermal_lengths.push_back({item.joint, item.number("share_per_kelvin")});
  });
}

void read_instrument_errors(const YamlNode& errors, Scenario& scenario) {
  if (const YamlNode* tool = errors.find("tool_mm")) scenario.tool_error_m = metres(1.0) * tool->vector3();
  if (const YamlNode* scale = errors.find("sensor_scale")) {
    scenario.sensor_scale.share = scale->with_keys({"share"}).at("share").number(-0.5, 0.5);
  }
  const YamlNode* drift = errors.find("drift");
  if (!drift) return;
  drift->with_keys({"mm_per_s", "deg_per_s"});
  if (const YamlNode* moved = drift->find("mm_per_s")) scenario.drift.metres_per_s = metres(1.0) * moved->vector3();
  if (const YamlNode* turned = drift->find("deg_per_s")) scenario.drift.rad_per_s = radians(1.0) * turned->vector3();
}

}  // namespace

void read_true_errors(const YamlNode& errors, Scenario& scenario) {
  errors.with_keys({"geometry", "joint_errors", "backlash", "hysteresis", "compliance", "link_bending", "gear_harmonic",
                    "gain", "eccentricity", "coupling", "axis_wobble", "thermal_offset", "thermal_length", "symbolic",
                    "drift", "sensor_scale", "tool_mm"});
  read_gear_errors(errors, scenario);
  read_side_and_load_errors(errors, scenario);
  read_axis_and_thermal_errors(errors, scenario);
  read_instrument_errors(errors, scenario);
}

}  // namespace demecal
