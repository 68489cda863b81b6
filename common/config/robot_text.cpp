#include "config/robot_text.hpp"

#include <sstream>

#include "config/yaml_text.hpp"

namespace demecal {
namespace {

std::string joint_text(const Joint& joint) {
  const bool revolute = is_revolute(joint);
  const auto limit = revolute ? degrees_text : millimetres_text;
  std::ostringstream text;
  text << "{type: " << (revolute ? "revolute" : "prismatic") << ", alpha_deg: " << degrees_text(joint.alpha_rad)
       << ", a_mm: " << millimetres_text(joint.a_m) << ", d_mm: " << millimetres_text(joint.d_m)
       << ", theta_offset_deg: " << degrees_text(joint.theta_rad);
  if (joint.beta_rad != 0.0) text << ", beta_deg: " << degrees_text(joint.beta_rad);
  text << (revolute ? ", limits_deg: [" : ", limits_mm: [") << limit(joint.lower) << ", " << limit(joint.upper) << "]}";
  return text.str();
}

std::string home_text(const Robot& robot) {
  std::string values;
  for (Eigen::Index i = 0; i < robot.home.size(); ++i) {
    const bool revolute = is_revolute(robot.chain, i);
    values += (i == 0 ? "" : ", ") + (revolute ? degrees_text(robot.home[i]) : millimetres_text(robot.home[i]));
  }
  return "[" + values + "]";
}

}  // namespace

std::string robot_text(const Robot& robot, int indent) {
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  const char* convention = robot.chain.convention == Convention::standard_dh ? "standard_dh" : "modified_dh";
  std::ostringstream text;
  text << margin << "name: " << yaml_text(robot.name) << '\n';
  text << margin << "convention: " << convention << '\n';
  text << margin << "joints:\n";
  for (const Joint& joint : robot.chain.joints) text << margin << "  - " << joint_text(joint) << '\n';
  text << margin << "tool_mm: " << yaml_mm(robot.chain.tool_m) << '\n';
  if (!robot.masses.empty()) text << margin << "links:\n";
  for (const LinkMass& link : robot.masses) {
    text << margin << "  - {mass_kg: " << number_text(link.mass_kg) << ", com_mm: " << yaml_mm(link.centre_m) << "}\n";
  }
  text << margin << "gravity_mps2: " << yaml_numbers({robot.gravity_mps2.data(), 3}) << '\n';
  if (robot.repeatability_m) text << margin << "repeatability_mm: " << millimetres_text(*robot.repeatability_m) << '\n';
  if (robot.home.size() > 0) text << margin << "home_deg: " << home_text(robot) << '\n';
  return text.str();
}

}  // namespace demecal
