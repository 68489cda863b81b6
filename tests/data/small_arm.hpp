// A small arm and tables of its poses, for the tests of reading data.
#pragma once

#include <numbers>
#include <sstream>
#include <string>

#include "../errors/complaint.hpp"
#include "data/csv.hpp"
#include "data/read_poses.hpp"
#include "kinematics/forward.hpp"

namespace demecal {

inline CsvTable table_of(const std::string& text) {
  std::istringstream stream(text);
  return read_csv(stream, "poses.csv");
}

/// Two revolute joints of 0.5 m each and a prismatic one.
inline Chain small_arm() {
  constexpr double kPi = std::numbers::pi;
  Chain chain;
  chain.joints = {Joint{.a_m = 0.5, .alpha_rad = 0.5 * kPi, .lower = -kPi, .upper = kPi},
                  Joint{.a_m = 0.5, .lower = -kPi, .upper = kPi},
                  Joint{.type = JointType::prismatic, .lower = 0.0, .upper = 0.3}};
  chain.tool_m = {0.0, 0.1, 0.0};
  return chain;
}

inline ColumnName column(const std::string& name) {
  return {name, {"set.yaml", 5}};
}

inline std::vector<ColumnName> columns_named(const std::vector<std::string>& names) {
  std::vector<ColumnName> columns;
  for (const std::string& name : names) columns.push_back(column(name));
  return columns;
}

/// Joints and position of the small arm, by these names.
inline ColumnMap small_map(const std::vector<std::string>& joints = {"q1_deg", "q2_deg", "q3_mm"},
                           const std::vector<std::string>& position = {"x_mm", "y_mm", "z_mm"}) {
  ColumnMap map;
  map.where = {"set.yaml", 4};
  map.joints = columns_named(joints);
  map.position = columns_named(position);
  return map;
}

/// What the exact arm would measure: `poses` rows over a few tens of degrees, angles and lengths multiplied by the
/// scales given before they are written under the headings of small_map().
inline std::string exact_table(int poses, double angle_scale, double length_scale, const std::string& heading) {
  std::ostringstream text;
  text.precision(17);
  text << heading << '\n';
  for (int k = 0; k < poses; ++k) {
    JointVector q(3);
    q << -1.0 + 0.2 * k, 0.7 - 0.13 * k, 0.01 * k;
    const Eigen::Vector3d p = tool_position(small_arm(), q) * length_scale;
    text << q[0] * angle_scale << ',' << q[1] * angle_scale << ',' << q[2] * 1000.0 << ',' << p.x() << ',' << p.y()
         << ',' << p.z() << '\n';
  }
  return text.str();
}

}  // namespace demecal
