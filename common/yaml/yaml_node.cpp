#include "yaml/yaml_node.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "data/columns.hpp"
#include "data/text.hpp"

namespace demecal::inline yaml {
namespace {

constexpr std::string_view kVersionPrefix = "demecal_";

template <typename Whole>
bool parse_whole(const YamlNode& node, Whole& value) {
  const char* end = node.scalar.data() + node.scalar.size();
  const auto [stop, fault] = std::from_chars(node.scalar.data(), end, value);
  return node.kind == YamlNode::Kind::scalar && !node.quoted && fault == std::errc{} && stop == end;
}

void require_map(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::map)
    node.fail(node.key.empty() ? "" : node.scalar, "must be a map of keys and values");
}

constexpr std::array<std::string_view, 4> kKeyUnits{"deg", "rad", "mm", "m"};

std::string expected_keys(const std::string& stem, JointType joint) {
  return joint == JointType::revolute ? stem + "_deg or " + stem + "_rad" : stem + "_mm or " + stem + "_m";
}

}  // namespace

void YamlNode::fail(const std::string& value, const std::string& rule) const {
  throw InputError({file, line}, value, key.empty() ? rule : key + " " + rule);
}

const YamlNode& YamlNode::with_keys(std::initializer_list<std::string_view> allowed) const {
  const std::vector<std::string> names(allowed.begin(), allowed.end());
  return with_keys(names);
}

const YamlNode& YamlNode::with_keys(std::span<const std::string> allowed) const {
  require_map(*this);
  for (const YamlNode& child : children) {
    if (std::find(allowed.begin(), allowed.end(), child.name) != allowed.end()) continue;
    const std::string where = key.empty() ? "" : " of " + key;
    const InputError fault({child.file, child.line}, child.name,
                           "is no key" + where + "; the nearest is '" + nearest_name(child.name, allowed) +
                               "'. Keys that are allowed here: " + joined_words(allowed, " "));
    throw UnknownKey(fault, {allowed.begin(), allowed.end()});
  }
  return *this;
}

const YamlNode& YamlNode::with_version(const std::string& file_kind, int version) const {
  require_map(*this);
  const std::string expected = std::string(kVersionPrefix) + file_kind;
  if (const YamlNode* found = find(expected)) {
    if (found->whole_number(0, 1000000) != version) found->fail("must be " + std::to_string(version));
    return *this;
  }
  for (const YamlNode& child : children) {
    if (child.name.starts_with(kVersionPrefix)) {
      child.fail(child.name,
                 "marks another kind of file; " + expected + ": " + std::to_string(version) + " is expected");
    }
  }
  fail("", expected + ": " + std::to_string(version) + " is missing: it says what kind of file this is");
}

const YamlNode* YamlNode::find(std::string_view child) const {
  require_map(*this);
  const auto found =
      std::find_if(children.begin(), children.end(), [&](const auto& node) { return node.name == child; });
  return found == children.end() ? nullptr : &*found;
}

const YamlNode& YamlNode::at(std::string_view child) const {
  if (const YamlNode* found = find(child)) return *found;
  throw InputError({file, line}, "", (key.empty() ? "" : key + ".") + std::string(child) + " is missing");
}

const std::vector<YamlNode>& YamlNode::list() const {
  if (kind != Kind::list) fail("must be a list");
  return children;
}

const std::vector<YamlNode>& YamlNode::list(std::size_t size) const {
  if (list().size() != size) {
    fail("", "must have " + std::to_string(size) + " elements, not " + std::to_string(children.size()));
  }
  return children;
}

const std::string& YamlNode::text() const {
  if (kind != Kind::scalar || scalar.empty()) fail("must be a text");
  return scalar;
}

double YamlNode::number() const {
  const auto value = kind == Kind::scalar && !quoted ? parse_number(scalar) : std::nullopt;
  if (!value) fail("must be a number");
  return *value;
}

double YamlNode::number(double lower, double upper) const {
  const double value = number();
  if (value < lower || value > upper) fail("must lie within " + number_text(lower) + " to " + number_text(upper));
  return value;
}

double YamlNode::positive() const {
  const double value = number();
  if (value <= 0.0) fail("must be positive");
  return value;
}

double YamlNode::non_negative() const {
  const double value = number();
  if (value < 0.0) fail("must not be negative");
  return value;
}

std::int64_t YamlNode::whole_number(std::int64_t lower, std::int64_t upper) const {
  std::int64_t value = 0;
  if (!parse_whole(*this, value)) fail("must be a whole number");
  if (value < lower || value > upper) fail("must lie within " + std::to_string(lower) + " to " + std::to_string(upper));
  return value;
}

std::uint64_t YamlNode::seed() const {
  std::uint64_t value = 0;
  if (!parse_whole(*this, value)) fail("must be a whole number from 0 to 18446744073709551615");
  return value;
}

bool YamlNode::boolean() const {
  return one_of<bool>({{"true", true}, {"false", false}});
}

std::vector<double> YamlNode::numbers() const {
  std::vector<double> values;
  for (const YamlNode& item : list()) values.push_back(item.number());
  return values;
}

Eigen::Vector2d YamlNode::vector2() const {
  const auto& items = list(2);
  return {items[0].number(), items[1].number()};
}

Eigen::Vector3d YamlNode::vector3() const {
  const auto& items = list(3);
  return {items[0].number(), items[1].number(), items[2].number()};
}

std::pair<double, double> YamlNode::range() const {
  const Eigen::Vector2d ends = vector2();
  if (ends[0] >= ends[1])
    fail("[" + children[0].scalar + ", " + children[1].scalar + "]", "must rise from lower to upper");
  return {ends[0], ends[1]};
}

void YamlNode::fail_choice(std::span<const std::string> words) const {
  if (kind != Kind::scalar) fail("must be one of: " + joined_words(words, " "));
  fail("must be one of: " + joined_words(words, " ") + "; the nearest is '" + nearest_name(scalar, words) + "'");
}

int joint_at(const YamlNode& map, std::string_view key, const Chain& chain) {
  return static_cast<int>(map.at(key).whole_number(1, chain.size())) - 1;
}

std::vector<std::string> keys_with_units(const std::vector<std::string>& stems) {
  std::vector<std::string> keys;
  for (const std::string& stem : stems) {
    for (const std::string_view unit : kKeyUnits) keys.push_back(stem + "_" + std::string(unit));
  }
  return keys;
}

std::optional<MeasuredNode> find_measured(const YamlNode& map, const std::string& stem, JointType joint) {
  const Quantity expected = joint == JointType::revolute ? Quantity::angle : Quantity::length;
  std::optional<MeasuredNode> measured;
  for (const std::string_view name : kKeyUnits) {
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

}  // namespace demecal::inline yaml
