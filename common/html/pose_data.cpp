#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "html/sections.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

/// A text of JavaScript and JSON, whatever its bytes: nothing in it ends the script or is taken for markup.
std::string script_text(std::string_view text) {
  std::string made = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      made += '\\';
      made += letter;
    } else if (code < 0x20 || letter == '<' || letter == '>' || letter == '&') {
      made += fmt::format("\\u{:04x}", code);
    } else {
      made += letter;
    }
  }
  return made + '"';
}

std::string script_number(std::optional<double> value, int decimals) {
  if (!value || !std::isfinite(*value)) return "null";
  std::string text = fmt::format("{:.{}f}", *value, decimals);
  if (text.find('.') != std::string::npos) {
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

/// `"key":[...],` of what `item` says of every pose.
template <typename Item>
std::string pose_array(const char* key, const Report& report, const Item& item) {
  std::string text = fmt::format("\"{}\":[", key);
  bool first = true;
  for (const PoseErrorEntry& pose : report.pose_errors) {
    const std::string one = item(pose);
    if (one.empty()) continue;
    text += (first ? "" : ",") + one;
    first = false;
  }
  return text + "],\n";
}

std::string number_list(const std::vector<double>& numbers, int decimals) {
  std::string text;
  for (const double one : numbers) text += (text.empty() ? "" : ",") + script_number(one, decimals);
  return text;
}

/// Numbers of every pose, one after the other; none where one pose has not so many.
std::string vectors(const char* key, const Report& report, std::vector<double> PosePlace::*values, std::size_t size,
                    int decimals) {
  const bool complete = std::ranges::all_of(
      report.pose_errors, [&](const PoseErrorEntry& pose) { return (pose.place.*values).size() == size; });
  if (!complete) return fmt::format("\"{}\":[],\n", key);
  return pose_array(key, report, [&](const PoseErrorEntry& pose) { return number_list(pose.place.*values, decimals); });
}

int flag_bits(const PoseErrorEntry& pose) {
  constexpr std::string_view kFlags[] = {"outlier", "near_singular", "outside_measured"};
  int bits = 0;
  for (int bit = 0; bit < 3; ++bit) {
    if (std::ranges::find(pose.flags, kFlags[bit]) != pose.flags.end()) bits |= 1 << bit;
  }
  return bits;
}

std::string arm_text(const Report& report) {
  if (!report.arm) return "null";
  constexpr int kDecimals = 6;
  std::string joints;
  for (const ArmJointEntry& joint : report.arm->joints) {
    joints += (joints.empty() ? "" : ",") + fmt::format("{{\"type\":{},\"placement\":[{}]}}", script_text(joint.type),
                                                        number_list(joint.placement, kDecimals));
  }
  std::string couplings;
  for (const ArmCouplingEntry& one : report.arm->couplings)
    couplings += fmt::format("{}[{},{},{}]", couplings.empty() ? "" : ",", one.joint, one.from,
                             script_number(one.factor, kDecimals));
  return fmt::format("{{\"base\":[{}],\"joints\":[{}],\"flange\":[{}],\"tool\":[{}],\"couplings\":[{}]}}",
                     number_list(report.arm->base, kDecimals), joints, number_list(report.arm->flange, kDecimals),
                     number_list(report.arm->tool_mm, kDecimals), couplings);
}

/// Whether the numbers are as many as a picture of the arm takes.
bool is_drawable(const Report& report) {
  constexpr std::size_t kPlacement = 12;
  if (!report.arm || report.arm->base.size() != kPlacement || report.arm->flange.size() != kPlacement) return false;
  const std::vector<ArmJointEntry>& joints = report.arm->joints;
  const auto within = [&](std::uint64_t joint) { return joint >= 1 && joint <= joints.size(); };
  return report.arm->tool_mm.size() == 3 &&
         std::ranges::all_of(report.arm->couplings,
                             [&](const ArmCouplingEntry& one) { return within(one.joint) && within(one.from); }) &&
         std::ranges::all_of(joints, [](const ArmJointEntry& one) { return one.placement.size() == kPlacement; }) &&
         std::ranges::all_of(report.pose_errors,
                             [&](const PoseErrorEntry& pose) { return pose.place.joints.size() == joints.size(); });
}

}  // namespace

std::string pose_data(const Report& report) {
  const std::size_t joints = report.arm ? report.arm->joints.size() : 0;
  const auto set_letter = [](const PoseErrorEntry& pose) { return pose.set.empty() ? 'c' : pose.set.front(); };
  std::string sets;
  for (const PoseErrorEntry& pose : report.pose_errors) sets += set_letter(pose);
  std::string text = "{" + pose_array("id", report, [](const PoseErrorEntry& pose) { return script_text(pose.id); });
  text += pose_array("target", report, [](const PoseErrorEntry& pose) { return script_text(pose.target); });
  text += "\"set\":" + script_text(sets) + ",\n";
  text += pose_array("before", report, [](const PoseErrorEntry& pose) { return script_number(pose.before_mm, 4); });
  text += pose_array("after", report, [](const PoseErrorEntry& pose) { return script_number(pose.after_mm, 4); });
  text += pose_array("within", report, [](const PoseErrorEntry& pose) { return script_number(pose.interval95_mm, 4); });
  text += pose_array("flags", report, [](const PoseErrorEntry& pose) { return std::to_string(flag_bits(pose)); });
  text += pose_array("temperature", report,
                     [](const PoseErrorEntry& p) { return script_number(p.place.temperature_celsius, 2); });
  text += pose_array("time", report, [](const PoseErrorEntry& pose) { return script_number(pose.place.time_s, 1); });
  text += vectors("q", report, &PosePlace::joints, joints, 3);
  text += vectors("p", report, &PosePlace::position_mm, 3, 2);
  text += vectors("eb", report, &PosePlace::before_error_mm, 3, 4);
  text += vectors("ea", report, &PosePlace::after_error_mm, 3, 4);
  return text + "\"arm\":" + (is_drawable(report) ? arm_text(report) : "null") + "}";
}

}  // namespace demecal::inline html
