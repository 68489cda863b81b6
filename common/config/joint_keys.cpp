#include "config/joint_keys.hpp"

#include <array>

#include "data/column_unit.hpp"

namespace demecal {
namespace {

constexpr std::array<std::string_view, 4> kUnits{"deg", "rad", "mm", "m"};

std::string expected_keys(const std::string& stem, JointType joint) {
  return joint == JointType::revolute ? stem + "_deg or " + stem + "_rad" : stem + "_mm or " + stem + "_m";
}

}  // namespace

int joint_at(const YamlNode& map, std::string_view key, const Chain& chain) {
  return static_cast<int>(map.at(key).whole_number(1, chain.size())) - 1;
}

std::vector<std::string> keys_with_units(const std::vector<std::string>& stems) {
  std::vector<std::string> keys;
  for (const std::string& stem : stems) {
    for (const std::string_view unit : kUnits) keys.push_back(stem + "_" + std::string(unit));
  }
  return keys;
}

std::optional<MeasuredNode> find_measured(const YamlNode& map, const std::string& stem, JointType joint) {
  const Quantity expected = joint == JointType::revolute ? Quantity::angle : Quantity::length;
  std::optional<MeasuredNode> measured;
  for (const std::string_view name : kUnits) {
    const YamlNode* found = map.find(stem + "_" + std::string(name));
    if (!found) continue;
    const ColumnUnit unit = *find_unit(name);
    if (unit.quantity != expected)
      found->fail("", "has the wrong unit for its joint: give " + expected_keys(stem, joint));
    if (measured) found->fail("", "gives a value that another unit has given already");
    measured = MeasuredNode{found, unit.to_inside};
  }
  return measured;
}

double measured_at(const YamlNode& map, const std::string& stem, JointType joint) {
  const auto measured = find_measured(map, stem, joint);
  if (!measured) map.fail("", "lacks " + expected_keys(stem, joint));
  return measured->number();
}

double measured_or_zero(const YamlNode& map, const std::string& stem, JointType joint) {
  const auto measured = find_measured(map, stem, joint);
  return measured ? measured->number() : 0.0;
}

}  // namespace demecal
