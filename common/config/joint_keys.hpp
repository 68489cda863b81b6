// Keys whose unit depends on the joint they speak of: degrees or radians of a revolute joint, mm or m of a prismatic
// one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/yaml_node.hpp"
#include "kinematics/chain.hpp"

namespace demecal {

/// The joint, from 0, that the map's `key` names from 1.
int joint_at(const YamlNode& map, std::string_view key, const Chain& chain);

/// "STEM_deg", "STEM_rad", "STEM_mm" and "STEM_m" for every stem: what a map may hold for any joint.
std::vector<std::string> keys_with_units(const std::vector<std::string>& stems);

/// A value with its unit: where it stands, and how it becomes rad or m.
struct MeasuredNode {
  const YamlNode* node;
  double (*to_inside)(double);

  double number() const { return to_inside(node->number()); }
};

/// The value of `stem` in the map, in a unit that fits the joint; nothing where it is missing. Throws InputError where
/// it is given in two units or in one that does not fit.
std::optional<MeasuredNode> find_measured(const YamlNode& map, const std::string& stem, JointType joint);

/// Its number, rad or m; throws InputError where it is missing.
double measured_at(const YamlNode& map, const std::string& stem, JointType joint);
/// The same, 0 where it is missing.
double measured_or_zero(const YamlNode& map, const std::string& stem, JointType joint);

}  // namespace demecal
