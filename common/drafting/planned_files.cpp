#include "drafting/planned_files.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "data/columns.hpp"
#include "data/contacts.hpp"
#include "data/csv.hpp"
#include "data/text.hpp"
#include "data_files/data_set_file.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline drafting {
namespace {

std::string joint_number(const Chain& chain, const JointVector& joints, int joint) {
  constexpr double kPerUnit = 1e3;
  const double value = is_revolute(chain, joint) ? degrees(joints[joint]) : millimetres(joints[joint]);
  return number_text(std::round(value * kPerUnit) / kPerUnit + 0.0);
}

std::vector<std::string> joint_headings(const Chain& chain) {
  std::vector<std::string> names;
  for (int i = 0; i < chain.size(); ++i)
    names.push_back("q" + std::to_string(i + 1) + (is_revolute(chain, i) ? "_deg" : "_mm"));
  return names;
}

std::vector<std::string> approach_headings(const Chain& chain) {
  std::vector<std::string> names;
  for (int i = 0; i < chain.size(); ++i) names.push_back("s" + std::to_string(i + 1));
  return names;
}

bool measures_orientation(const PlanRequest& request) {
  return request.cell && request.cell->instrument && request.cell->instrument->measures_orientation;
}

}  // namespace

std::string planned_poses_csv(const Plan& plan, const PlanRequest& request) {
  const Chain& chain = request.robot.chain;
  CsvTable table{.file = {}, .header_line = 0, .columns = {"set", "pose_id"}, .rows = {}};
  for (std::string& name : joint_headings(chain)) table.columns.push_back(std::move(name));
  for (std::string& name : approach_headings(chain)) table.columns.push_back(std::move(name));
  std::vector<std::string> targets;
  for (const auto& [target, tool_m] : request.tools_m) targets.push_back(target);
  if (targets.empty()) targets.emplace_back();
  if (!request.tools_m.empty()) table.columns.emplace_back("target_id");
  if (!plan.sockets.empty()) table.columns.emplace_back("contact_id");
  for (const PlannedStop& stop : plan.stops) {
    for (const std::string& target : targets) {
      CsvRow row{0, {std::string(to_string(stop.set)), stop.id}};
      for (int i = 0; i < chain.size(); ++i) row.fields.push_back(joint_number(chain, stop.pose.joints, i));
      for (const double sign : stop.pose.approach) row.fields.push_back(number_text(sign));
      if (!request.tools_m.empty()) row.fields.push_back(target);
      if (stop.pose.socket) row.fields.push_back(plan.sockets[*stop.pose.socket].name);
      table.rows.push_back(std::move(row));
    }
  }
  return csv_text(table);
}

std::string planned_data_set_text(const Plan& plan, const PlanRequest& request) {
  std::ostringstream text;
  const bool touches = !plan.sockets.empty();
  text << yaml_comment(touches ? "Planned by demecal: put the joints in which the ball sat in its socket into poses.csv"
                               : "Planned by demecal: add the columns of what was measured to poses.csv, nothing else "
                                 "is missing")
       << "demecal_dataset: 1\nname: " << yaml_text(request.robot.name) << "\nrobot: robot.yaml\nposes: poses.csv\n"
       << "columns:\n  set: set\n  pose: pose_id\n  joints: " << yaml_list(joint_headings(request.robot.chain)) << '\n'
       << (touches ? "  contact: contact_id\n" : "  position: [x_mm, y_mm, z_mm]   # to be added\n");
  if (measures_orientation(request)) text << "  orientation: [qw, qx, qy, qz]   # to be added\n";
  if (!plan.stops.empty()) text << "  approach: " << yaml_list(approach_headings(request.robot.chain)) << '\n';
  if (!request.tools_m.empty()) {
    text << "  target: target_id\ntools_mm:\n";
    for (const auto& [target, tool_m] : request.tools_m)
      text << "  " << yaml_text(target) << ": " << yaml_mm(tool_m) << '\n';
  }
  if (!touches) text << "frame: sensor\n";
  if (!plan.lengths.empty()) text << contacts_text({.forms = {}, .distances = plan.lengths, .angles = {}});
  return text.str();
}

std::string planned_job_text(const PlanRequest& request, const std::filesystem::path& measured_file) {
  const std::string data = measured_file.empty()
                               ? "DATASET.yaml\n"
                               : "[" + yaml_text(measured_file.generic_string()) + ", DATASET.yaml]\n" +
                                     "station_tools: own   # shared: where no target was mounted anew\n";
  return "demecal_job: 1\ndata: " + data +
         "method: " + std::string(request.declared.joint_corrections ? "direct" : "diagnose") +
         "\nseed: " + std::to_string(request.seed) + "\nmodel: {declared: " + yaml_list(request.declared.words()) +
         "}\n";
}

namespace {

constexpr double kFine = 1e-3;   ///< of a degree or millimetre
constexpr double kFiner = 1e-6;  ///< of a radian or metre

/// How a joint's column is written.
struct JointColumn {
  std::string name;
  UnitConversion to_inside;

  std::string text(double inside) const {
    const double unit = to_inside(1.0), step = unit < 0.1 ? kFine : kFiner;
    const int digits = static_cast<int>(std::lround(-std::log10(step)));
    return fmt::format("{:.{}f}", inside / unit, digits);
  }
};

/// Whether the names of the data set's columns say all that a table of poses needs: not where they are numbers, or
/// where the file's own headings give the units.
bool names_suffice(const ColumnMap& columns, const AssumedUnits& units, const Chain& chain) {
  if (columns.joints.size() != chain.joints.size()) return false;
  for (std::size_t i = 0; i < columns.joints.size(); ++i) {
    const ColumnName& column = columns.joints[i];
    const std::size_t ending = column.name.rfind('_');
    const bool own = ending != std::string::npos && find_unit(lower_case(column.name.substr(ending + 1)));
    const bool assumed = is_revolute(chain.joints[i]) ? units.angle.has_value() : units.length.has_value();
    if (column.number > 0 || !(own || assumed)) return false;
  }
  return true;
}

std::vector<JointColumn> planned_joint_columns(const ColumnMap& columns, const AssumedUnits& units,
                                               const Chain& chain) {
  std::vector<JointColumn> joints;
  if (!names_suffice(columns, units, chain)) {
    for (std::size_t i = 0; i < chain.joints.size(); ++i) {
      const bool turns = is_revolute(chain.joints[i]);
      joints.push_back(
          {"q" + std::to_string(i + 1) + (turns ? "_deg" : "_mm"), find_unit(turns ? "deg" : "mm")->to_inside});
    }
    return joints;
  }
  for (std::size_t i = 0; i < columns.joints.size(); ++i) {
    const bool turns = is_revolute(chain.joints[i]);
    const ColumnUnit unit = unit_of(columns.joints[i], turns ? Quantity::angle : Quantity::length, units);
    joints.push_back({columns.joints[i].name, unit.to_inside});
  }
  return joints;
}

/// The names the data set gives to the joints' approach; where it has none, the customary ones.
std::vector<std::string> approach_names(const ColumnMap& columns, std::size_t joints) {
  std::vector<std::string> names;
  for (const ColumnName& column : columns.approach) {
    if (column.number == 0) names.push_back(column.name);
  }
  for (std::size_t i = names.size(); i < joints; ++i) names.push_back("s" + std::to_string(i + 1));
  return names;
}

/// Payloads under the data set's name for them, in the unit that it ends in.
struct PayloadColumn {
  std::string name = "payload_kg";
  UnitConversion to_inside = find_unit("kg")->to_inside;

  std::string text(double payload_kg) const { return fmt::format("{:.6g}", payload_kg / to_inside(1.0)); }
};
std::optional<PayloadColumn> payload_column(const ColumnMap& columns) {
  if (!columns.payload) return std::nullopt;
  if (columns.payload->number > 0) return PayloadColumn{};
  return PayloadColumn{columns.payload->name, unit_of(*columns.payload, Quantity::mass, {}).to_inside};
}

}  // namespace

std::string proposed_poses_csv(const std::filesystem::path& data_set_file, const DataSet& data,
                               const std::vector<Stop>& stops) {
  const YamlNode root = read_yaml(data_set_file);
  const ColumnMap columns = root.find("columns") ? read_column_map(root.at("columns"), ColumnsOf::part) : ColumnMap{};
  const std::vector<JointColumn> joints =
      planned_joint_columns(columns, read_units(root.find("units")), data.robot.chain);
  CsvTable table{.file = {},
                 .header_line = 0,
                 .columns = {columns.pose && columns.pose->number == 0 ? columns.pose->name : "pose_id"},
                 .rows = {}};
  for (const JointColumn& joint : joints) table.columns.push_back(joint.name);
  for (std::string& name : approach_names(columns, joints.size())) table.columns.push_back(std::move(name));
  const std::optional<PayloadColumn> payload = payload_column(columns);
  if (payload) table.columns.push_back(payload->name);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Stop& stop = stops[i];
    CsvRow row{0, {"N" + std::to_string(i + 1)}};
    for (std::size_t k = 0; k < joints.size(); ++k) {
      row.fields.push_back(joints[k].text(stop.joints[static_cast<Eigen::Index>(k)]));
    }
    for (Eigen::Index k = 0; k < stop.joints.size(); ++k) {
      row.fields.push_back(fmt::format("{:.0f}", stop.approach.size() > 0 ? stop.approach[k] : 0.0));
    }
    if (payload) row.fields.push_back(payload->text(stop.payload_kg));
    table.rows.push_back(std::move(row));
  }
  return csv_text(table);
}

}  // namespace demecal::inline drafting
