#include "data_files/doubtful_units.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {
namespace {

// Lengths between are none of a real link's, by drawings: in metres they are those of most arms.
constexpr double kShortest_mm = 0.02, kLongest_mm = 2.0;

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

bool may_be_metres(double largest_mm) {
  return largest_mm >= kShortest_mm && largest_mm < kLongest_mm;
}

class DoubtfulUnits {
 public:
  explicit DoubtfulUnits(const YamlNode& file) : file_(file) {}

  std::vector<std::string> all() {
    for (const char* const list : {"joints", "positioner"})
      if (const YamlNode* const joints = file_.find(list))
        for (const YamlNode& joint : joints->list()) look_at_joint(joint);
    for (const char* const place : {"base", "workpiece", "flange"})
      if (const YamlNode* const node = file_.find(place)) look_at_length(node->find("xyz_mm"));
    look_at_length(file_.find("tool_mm"));
    return std::move(sentences_);
  }

 private:
  void look_at_joint(const YamlNode& joint) {
    constexpr double kWholeTurn = 2.0 * std::numbers::pi + 0.02;
    if (const YamlNode* const limits = joint.find("limits_deg"); limits && largest_of(limits->numbers()) <= kWholeTurn)
      say(*limits, "radians; degrees are expected");
    for (const char* const length : {"a_mm", "d_mm", "xyz_mm", "limits_mm"}) look_at_length(joint.find(length));
  }

  void look_at_length(const YamlNode* node) {
    if (node == nullptr) return;
    const bool list = node->kind == YamlNode::Kind::list;
    if (may_be_metres(list ? largest_of(node->numbers()) : std::abs(node->number())))
      say(*node, "metres; millimetres are expected");
  }

  void say(const YamlNode& node, const char* what) {
    std::string value = node.scalar;
    for (const YamlNode& child : node.children) value += (value.empty() ? "" : ", ") + child.scalar;
    if (node.kind == YamlNode::Kind::list) value = '[' + value + ']';
    sentences_.push_back(fmt::format("{}:{}: '{}': {} looks like {}", node.file, node.line, value, node.key, what));
  }

  const YamlNode& file_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::vector<std::string> doubtful_units(const std::filesystem::path& robot_file) {
  const YamlNode file = read_yaml(robot_file);
  return DoubtfulUnits(file).all();
}

}  // namespace demecal::inline data_files
