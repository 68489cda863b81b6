#include "report/pose_csv.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "report/history.hpp"

namespace demecal::inline report {
namespace {

using Vectors = std::vector<double> PosePlace::*;

std::string cell(const std::optional<double>& value) {
  return value ? number_text(*value) : std::string();
}

/// As many cells as `count`, empty where there are fewer numbers.
void add_cells(const std::vector<double>& values, std::size_t count, CsvRow& row) {
  for (std::size_t i = 0; i < count; ++i)
    row.fields.push_back(i < values.size() ? number_text(values[i]) : std::string());
}

std::string joined(const std::vector<std::string>& flags) {
  std::string text;
  for (const std::string& flag : flags) text += (text.empty() ? "" : " ") + flag;
  return text;
}

struct VectorColumns {
  Vectors values;
  const char* names[3];
};
constexpr VectorColumns kVectors[] = {{&PosePlace::position_mm, {"x_mm", "y_mm", "z_mm"}},
                                      {&PosePlace::before_error_mm, {"before_x_mm", "before_y_mm", "before_z_mm"}},
                                      {&PosePlace::after_error_mm, {"after_x_mm", "after_y_mm", "after_z_mm"}}};

}  // namespace

std::string pose_errors_csv(const Report& report) {
  const std::vector<PoseErrorEntry>& poses = report.pose_errors;
  const auto any = [&poses](const auto& has) { return std::ranges::any_of(poses, has); };
  std::size_t joints = 0;
  for (const PoseErrorEntry& pose : poses) joints = std::max(joints, pose.place.joints.size());
  CsvTable table;
  table.columns = {"id", "target", "set", "before_mm", "after_mm", "interval95_mm", "flags"};
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const bool slides =
        report.arm && joint < report.arm->joints.size() && report.arm->joints[joint].type == "prismatic";
    table.columns.push_back("q" + std::to_string(joint + 1) + (slides ? "_mm" : "_deg"));
  }
  std::vector<VectorColumns> vectors;
  for (const VectorColumns& columns : kVectors) {
    if (!any([&](const PoseErrorEntry& pose) { return !(pose.place.*columns.values).empty(); })) continue;
    vectors.push_back(columns);
    table.columns.insert(table.columns.end(), std::begin(columns.names), std::end(columns.names));
  }
  const bool warm = any([](const PoseErrorEntry& pose) { return pose.place.temperature_celsius.has_value(); });
  const bool timed = any([](const PoseErrorEntry& pose) { return pose.place.time_s.has_value(); });
  if (warm) table.columns.emplace_back("temperature_celsius");
  if (timed) table.columns.emplace_back("time_s");
  for (const PoseErrorEntry& pose : poses) {
    CsvRow& row = table.rows.emplace_back();
    row.fields = {on_one_line(pose.id), on_one_line(pose.target), pose.set,          cell(pose.before_mm),
                  cell(pose.after_mm),  cell(pose.interval95_mm), joined(pose.flags)};
    add_cells(pose.place.joints, joints, row);
    for (const VectorColumns& columns : vectors) add_cells(pose.place.*columns.values, 3, row);
    if (warm) row.fields.push_back(cell(pose.place.temperature_celsius));
    if (timed) row.fields.push_back(cell(pose.place.time_s));
  }
  std::ostringstream text;
  write_csv(text, table);
  return text.str();
}

}  // namespace demecal::inline report
