#include "report/pose_places.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"

namespace demecal::inline report {
namespace {

/// To a millionth of the border's unit: what pictures and tables need, in few digits.
double rounded(double value) {
  constexpr double kSteps = 1e6;
  return std::round(kSteps * value) / kSteps + 0.0;
}

std::vector<double> in_mm(const Eigen::Vector3d& vector_m) {
  std::vector<double> numbers;
  for (const double component : vector_m) numbers.push_back(rounded(millimetres(component)));
  return numbers;
}

PlacementNumbers placement(const Eigen::Isometry3d& pose) {
  PlacementNumbers numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers.push_back(rounded(pose.linear()(row, column)));
    numbers.push_back(rounded(millimetres(pose.translation()[row])));
  }
  return numbers;
}

}  // namespace

PosePlace pose_place(const DataSet& data, const MeasuredPose& pose, const CorrectedRobot& before,
                     const CorrectedRobot& after) {
  PosePlace place;
  for (int joint = 0; joint < pose.joints.size(); ++joint) {
    const bool turns = data.robot.chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
    place.joints.push_back(rounded(turns ? degrees(pose.joints[joint]) : millimetres(pose.joints[joint])));
  }
  place.temperature_celsius = pose.temperature_celsius;
  place.time_s = pose.time_s;
  if (!pose.position_m) return place;
  const Stop stop(pose);
  place.position_mm = in_mm(*pose.position_m);
  place.before_error_mm = in_mm(measured_point(before, pose) - before.predict(stop, pose.target).translation());
  place.after_error_mm = in_mm(measured_point(after, pose) - after.predict(stop, pose.target).translation());
  return place;
}

ArmEntry arm_entry(const CorrectedRobot& robot, const std::string& target) {
  ArmEntry arm;
  arm.base = placement(robot.sensor_from_base);
  arm.tool_mm = in_mm(robot.tool(target).translation());
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  walk(
      robot.chain, JointVector::Zero(robot.chain.size()), [](int, LinkParameter, const Screw&) {},
      [&](int joint, const Eigen::Isometry3d& frame) {
        const PlacementNumbers here = placement(last.inverse() * frame);
        last = frame;
        if (joint == robot.chain.size()) {
          arm.flange = here;
          return;
        }
        const bool turns = robot.chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
        arm.joints.push_back({turns ? "revolute" : "prismatic", here});
      });
  for (const CommandCoupling& coupling : robot.chain.couplings)
    arm.couplings.push_back({static_cast<std::uint64_t>(coupling.joint) + 1,
                             static_cast<std::uint64_t>(coupling.from) + 1, coupling.factor});
  return arm;
}

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
