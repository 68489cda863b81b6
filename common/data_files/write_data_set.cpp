#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "effects/arm_state.hpp"
#include "errors/check.hpp"
#include "kinematics/chain.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline data_files {
namespace {

/// One column of the table: its heading, and its field for a pose.
struct WrittenColumn {
  std::string heading;
  std::function<std::string(const MeasuredPose&)> field;
};

/// The columns of one key of `columns:`.
struct ColumnGroup {
  std::string key;
  bool is_list = true;
  std::vector<WrittenColumn> columns;
};

/// Whether the poses have the quantity: all or none of them must.
template <typename Has>
bool measured(const DataSet& data, const Has& has) {
  const auto count = std::count_if(data.poses.begin(), data.poses.end(), has);
  DEMECAL_CHECK(count == 0 || count == static_cast<std::ptrdiff_t>(data.poses.size()), "count=" << count);
  return count > 0;
}

/// The heading of one of several like columns, such as "q1_deg", for an index from 0.
std::string numbered_heading(std::string_view name, std::size_t index, std::string_view ending) {
  std::ostringstream heading;
  heading << name << index + 1 << ending;
  return heading.str();
}

ColumnGroup joint_group(const Chain& chain) {
  ColumnGroup group{.key = "joints", .columns = {}};
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const bool revolute = is_revolute(chain.joints[i]);
    group.columns.push_back({numbered_heading("q", i, revolute ? "_deg" : "_mm"), [=](const MeasuredPose& pose) {
                               const double value = pose.joints[static_cast<Eigen::Index>(i)];
                               return revolute ? degrees_text(value) : millimetres_text(value);
                             }});
  }
  return group;
}

ColumnGroup position_columns() {
  ColumnGroup group{.key = "position", .columns = {}};
  for (int axis = 0; axis < 3; ++axis) {
    group.columns.push_back({std::string(1, "xyz"[axis]) + "_mm",
                             [=](const MeasuredPose& pose) { return millimetres_text((*pose.position_m)[axis]); }});
  }
  return group;
}

/// Of covariances without correlation, the only ones that columns can hold whatever the instrument.
ColumnGroup sigma_columns() {
  ColumnGroup group{.key = "sigma", .columns = {}};
  for (int axis = 0; axis < 3; ++axis) {
    group.columns.push_back({std::string("s") + "xyz"[axis] + "_mm", [=](const MeasuredPose& pose) {
                               return millimetres_text(std::sqrt((*pose.position_covariance_m2)(axis, axis)));
                             }});
  }
  return group;
}

bool states_sigma(const DataSet& data) {
  return measured(data, [](const MeasuredPose& pose) {
    return pose.position_covariance_m2 && pose.position_covariance_m2->isDiagonal(1e-12);
  });
}

ColumnGroup orientation_columns() {
  ColumnGroup group{.key = "orientation", .columns = {}};
  for (int part = 0; part < 4; ++part) {
    const int coefficient = (part + 3) % 4;  // Eigen keeps x, y, z, w
    group.columns.push_back({std::string("q") + "wxyz"[part], [=](const MeasuredPose& pose) {
                               return number_text(pose.orientation->coeffs()[coefficient]);
                             }});
  }
  return group;
}

ColumnGroup distance_columns(std::size_t count) {
  ColumnGroup group{.key = "distances", .columns = {}};
  for (std::size_t i = 0; i < count; ++i) {
    group.columns.push_back({numbered_heading("l", i, "_mm"),
                             [=](const MeasuredPose& pose) { return millimetres_text(pose.distances_m[i]); }});
  }
  return group;
}

ColumnGroup approach_columns(std::size_t joints) {
  ColumnGroup group{.key = "approach", .columns = {}};
  for (std::size_t i = 0; i < joints; ++i) {
    group.columns.push_back({numbered_heading("s", i, ""), [=](const MeasuredPose& pose) {
                               return number_text((*pose.approach)[static_cast<Eigen::Index>(i)]);
                             }});
  }
  return group;
}

ColumnGroup torque_columns(const Chain& chain) {
  ColumnGroup group{.key = "torque", .columns = {}};
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const char* const unit = is_revolute(chain.joints[i]) ? "_nm" : "_n";
    group.columns.push_back({numbered_heading("torque", i, unit), [=](const MeasuredPose& pose) {
                               return number_text((*pose.torque)[static_cast<Eigen::Index>(i)]);
                             }});
  }
  return group;
}

using OptionalNumber = std::optional<double> MeasuredPose::*;

ColumnGroup single(const std::string& key, const std::string& heading, OptionalNumber value) {
  return {key, false, {{heading, [=](const MeasuredPose& pose) { return number_text(*(pose.*value)); }}}};
}

ColumnGroup single(const std::string& key, const std::string& heading, std::string MeasuredPose::*text) {
  return {key, false, {{heading, [=](const MeasuredPose& pose) { return pose.*text; }}}};
}

std::vector<ColumnGroup> column_groups(const DataSet& data) {
  const auto has = [&](auto member) {
    return measured(data, [=](const MeasuredPose& pose) { return (pose.*member).has_value(); });
  };
  const std::size_t distances = data.poses.empty() ? 0 : data.poses.front().distances_m.size();
  DEMECAL_CHECK(
      distances == 0 || measured(data, [=](const auto& pose) { return pose.distances_m.size() == distances; }),
      "distances=" << distances);
  const auto named = [](const MeasuredPose& pose) { return !pose.target.empty(); };
  std::vector<ColumnGroup> groups{
      {"set", false, {{"set", [](const MeasuredPose& pose) { return std::string(to_string(pose.set)); }}}},
      single("pose", "pose_id", &MeasuredPose::pose_id),
      joint_group(data.robot.chain)};
  if (has(&MeasuredPose::position_m)) groups.push_back(position_columns());
  if (states_sigma(data)) groups.push_back(sigma_columns());
  if (has(&MeasuredPose::orientation)) groups.push_back(orientation_columns());
  if (distances > 0) groups.push_back(distance_columns(distances));
  if (has(&MeasuredPose::approach)) groups.push_back(approach_columns(data.robot.chain.joints.size()));
  if (has(&MeasuredPose::torque)) groups.push_back(torque_columns(data.robot.chain));
  if (has(&MeasuredPose::payload_kg)) groups.push_back(single("payload", "payload_kg", &MeasuredPose::payload_kg));
  if (has(&MeasuredPose::temperature_celsius)) {
    groups.push_back(single("temperature", "temperature_celsius", &MeasuredPose::temperature_celsius));
  }
  if (has(&MeasuredPose::time_s)) groups.push_back(single("time", "time_s", &MeasuredPose::time_s));
  if (std::any_of(data.poses.begin(), data.poses.end(), named)) {
    groups.push_back(single("target", "target_id", &MeasuredPose::target));
  }
  if (has_contacts(data)) groups.push_back(single("contact", "contact_id", &MeasuredPose::contact));
  return groups;
}

CsvTable written_table(const DataSet& data, const std::vector<ColumnGroup>& groups) {
  CsvTable table;
  for (const ColumnGroup& group : groups) {
    for (const WrittenColumn& column : group.columns) table.columns.push_back(column.heading);
  }
  for (const MeasuredPose& pose : data.poses) {
    CsvRow row;
    for (const ColumnGroup& group : groups) {
      for (const WrittenColumn& column : group.columns) row.fields.push_back(column.field(pose));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string headings_text(const ColumnGroup& group) {
  std::vector<std::string> headings;
  for (const WrittenColumn& column : group.columns) headings.push_back(column.heading);
  return group.is_list ? yaml_list(headings) : headings.front();
}

std::string anchors_text(const DataSet& data) {
  if (data.anchors_unknown) return "anchors_mm: unknown\n";
  if (data.anchors_m.empty()) return "";
  std::vector<std::string> points;
  for (const Eigen::Vector3d& anchor_m : data.anchors_m) points.push_back(yaml_mm(anchor_m));
  return "anchors_mm: " + yaml_list(points) + "\n";
}

std::string tools_text(const DataSet& data) {
  std::string text = data.tools_m.empty() ? "" : "tools_mm:\n";
  for (const auto& [target, tool_m] : data.tools_m) text += "  " + yaml_text(target) + ": " + yaml_mm(tool_m) + "\n";
  return text;
}

std::string yaml_of(const DataSet& data, const std::vector<ColumnGroup>& groups, const std::string& purpose) {
  std::ostringstream text;
  text << yaml_comment(purpose) << "demecal_dataset: 1\nname: " << yaml_text(data.name)
       << "\nrobot: robot.yaml\nposes: poses.csv\ncolumns:\n";
  for (const ColumnGroup& group : groups) text << "  " << group.key << ": " << headings_text(group) << '\n';
  text << anchors_text(data) << tools_text(data) << contacts_text(data.contacts)
       << "frame: " << (data.frame == Frame::base ? "base" : "sensor") << '\n';
  return text.str();
}

}  // namespace

void write_robot(const Robot& robot, const std::filesystem::path& path, const std::string& purpose) {
  write_file(path, yaml_comment(purpose) + "demecal_robot: 1\n" + robot_text(robot));
}

std::filesystem::path write_data_set(const DataSet& data, const std::filesystem::path& folder,
                                     const std::string& purpose) {
  const std::vector<ColumnGroup> groups = column_groups(data);
  write_file(folder / "poses.csv", csv_text(written_table(data, groups)));
  write_robot(data.robot, folder / "robot.yaml", "the robot of " + data.name + ", nominal");
  write_file(folder / "dataset.yaml", yaml_of(data, groups, purpose));
  return folder / "dataset.yaml";
}

}  // namespace demecal::inline data_files
