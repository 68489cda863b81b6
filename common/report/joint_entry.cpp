#include "report/joint_entry.hpp"

#include <algorithm>

namespace demecal {
namespace {

std::optional<Interval> interval(const JsonValue& range) {
  const std::vector<double> ends = range.numbers();
  if (ends.empty()) return std::nullopt;
  if (ends.size() != 2 || ends[0] > ends[1]) range.refuse("must be the two ends of a range, the lower one first");
  return Interval{ends[0], ends[1]};
}

JointEntry entry(const JsonValue& json, std::uint64_t position) {
  JointEntry joint;
  joint.joint = json["joint"].count().value_or(position);
  joint.expression = json["expression"].text();
  joint.with_functions = json["with_functions"].text();
  joint.note = json["note"].text();
  joint.kept = json["kept"].truth().value_or(!joint.expression.empty());
  const JsonValue error = json["mean_abs_error_rad"];
  joint.before_rad = error["before"].number();
  joint.after_rad = error["after"].number();
  joint.bound_rad = json["bound_rad"].number();
  joint.range_rad = interval(json["range_rad"]);
  joint.jumps_rad = json["discontinuities_rad"].numbers();
  std::ranges::sort(joint.jumps_rad);
  return joint;
}

}  // namespace

std::vector<JointEntry> joint_entries(const JsonValue& report) {
  std::vector<JointEntry> joints;
  for (const JsonValue& json : report["joints"].elements()) joints.push_back(entry(json, joints.size() + 1));
  return joints;
}

}  // namespace demecal
