#include "coordinator/shown_robot.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "data/link_inertia.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

double border(const Joint& joint, double value) {
  return is_revolute(joint) ? degrees(value) : millimetres(value);
}

const char* unit_word(const Joint& joint) {
  return is_revolute(joint) ? "deg" : "mm";
}

/// 0 in place of what a computer leaves of it.
double displayed(double value) {
  return std::abs(value) < 5e-10 ? 0.0 : value;
}

std::string displayed(const std::vector<double>& values, int decimals) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.{}f}", text.empty() ? "" : "  ", displayed(value), decimals);
  return text;
}

std::vector<double> components_mm(const Eigen::Vector3d& point_m) {
  return {millimetres(point_m.x()), millimetres(point_m.y()), millimetres(point_m.z())};
}

std::string drawn_name(const Robot& robot, std::size_t joint) {
  return robot.drawing ? robot.drawing->joints[joint].name : std::string();
}

std::string limits_text(const Joint& joint) {
  if (joint.endless) return "turns on and on";
  return fmt::format("{:9.6g} .. {:.6g} {}", border(joint, joint.lower), border(joint, joint.upper), unit_word(joint));
}

void print_table(const Robot& robot) {
  const Chain& chain = robot.chain;
  const bool standard = chain.convention == Convention::standard_dh;
  const bool same = !robot.drawing || (!robot.drawing->by_axes &&
                                       std::ranges::none_of(robot.drawing->joints, [](const DrawnJoint& joint) {
                                         return joint.direction < 0 || joint.offset != 0.0;
                                       }));
  fmt::print("\n{} Denavit-Hartenberg table, {}:\n", standard ? "Standard" : "Modified",
             same ? "as in the file" : "equivalent to the file; axes point as the joints count");
  fmt::print("  {:5} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "joint", "theta deg", "d mm", "a mm", "alpha deg",
             "beta deg");
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& row = chain.joints[static_cast<std::size_t>(i)];
    fmt::print("  {:5} {:12.6f} {:12.4f} {:12.4f} {:12.6f} {:12.6f}\n", i + 1, displayed(degrees(row.theta_rad)),
               displayed(millimetres(row.d_m)), displayed(millimetres(row.a_m)), displayed(degrees(row.alpha_rad)),
               displayed(degrees(row.beta_rad)));
  }
}

void print_joints(const Robot& robot) {
  const Chain& chain = robot.chain;
  fmt::print("{}: {} joints\n\n", robot.name, chain.size());
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const bool reversed = robot.drawing && robot.drawing->joints[i].direction < 0;
    fmt::print("  joint {}  {:24} {:9}  {}{}{}\n", i + 1, drawn_name(robot, i),
               is_revolute(chain.joints[i]) ? "revolute" : "prismatic", limits_text(chain.joints[i]),
               reversed ? "  (counts the other way)" : "",
               static_cast<int>(i) < chain.positioner ? "  (carries the workpiece, from which poses count)" : "");
  }
  for (const CommandCoupling& coupling : chain.couplings)
    fmt::print("  joint {} is also turned by {:g} times the command of joint {}\n", coupling.joint + 1, coupling.factor,
               coupling.from + 1);
}

/// The centre of mass of a link in the link's frame as the file draws it.
Eigen::Vector3d drawn_centre_m(const Robot& robot, std::size_t link) {
  return robot.drawing ? robot.drawing->centres_m[link] : robot.masses[link].centre_m;
}

void print_links(const Robot& robot, const LinkInertias& inertias) {
  if (robot.masses.empty()) return;
  fmt::print(
      "\nLinks (inertias about the centre of mass are shown alone: an arm that stands still has no use for them):\n");
  for (std::size_t i = 0; i < robot.masses.size(); ++i) {
    fmt::print("  link {}  {:g} kg at {} mm", i + 1, robot.masses[i].mass_kg,
               displayed(components_mm(drawn_centre_m(robot, i)), 2));
    if (i < inertias.size() && inertias[i]) {
      const Eigen::Vector3d moments = principal_moments(*inertias[i]);
      fmt::print("; principal moments {:.4g}  {:.4g}  {:.4g} kg m^2", moments[0], moments[1], moments[2]);
    }
    fmt::print("\n");
  }
}

nlohmann::ordered_json links_json(const Robot& robot, const LinkInertias& inertias) {
  nlohmann::ordered_json links = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < robot.masses.size(); ++i) {
    nlohmann::ordered_json link{
        {"link", i + 1}, {"mass_kg", robot.masses[i].mass_kg}, {"com_mm", components_mm(drawn_centre_m(robot, i))}};
    if (i < inertias.size() && inertias[i]) link["inertia_kgm2"] = matrix_elements(*inertias[i]);
    links.push_back(std::move(link));
  }
  return links;
}

/// Of what poses are counted.
const char* frame_word(const Chain& chain) {
  return chain.positioner > 0 ? "workpiece" : "base";
}

void print_pose(const Robot& robot, const JointVector& q, const Eigen::Isometry3d& flange) {
  std::string at;
  for (int i = 0; i < robot.chain.size(); ++i) {
    const Joint& joint = robot.chain.joints[static_cast<std::size_t>(i)];
    at += fmt::format("{}{:.6g} {}", i == 0 ? "" : ", ", border(joint, q[i]), unit_word(joint));
  }
  const std::string frame = fmt::format(" in the {} frame, mm", frame_word(robot.chain));
  fmt::print("\nAt {}:\n  {:37} {}\n", at, "flange" + frame, displayed(components_mm(flange.translation()), 4));
  fmt::print("  {:37} {}\n", "tool point" + frame, displayed(components_mm(flange * robot.chain.tool_m), 4));
  fmt::print("  orientation of the flange\n");
  for (const ControllerAngles& angles : controller_angles(flange.linear())) {
    const int decimals = angles.values.size() == 4 || angles.names.ends_with("rad") ? 6 : 4;
    fmt::print("    {:35} {}\n", angles.controller + ", " + angles.names, displayed(angles.values, decimals));
  }
}

}  // namespace

std::vector<std::string> beyond_limits_sentences(const Chain& chain, const JointVector& q) {
  constexpr double kRounding = 1e-9;
  std::vector<std::string> sentences;
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    if (joint.endless || (q[i] >= joint.lower - kRounding && q[i] <= joint.upper + kRounding)) continue;
    sentences.push_back(fmt::format("joint {} at {:.6g} {} is beyond its limits, {:.6g} to {:.6g} {}", i + 1,
                                    border(joint, q[i]), unit_word(joint), border(joint, joint.lower),
                                    border(joint, joint.upper), unit_word(joint)));
  }
  return sentences;
}

std::string shown_json(const ShownRobot& shown) {
  const auto& [robot, inertias, q, warnings] = shown;
  const Eigen::Isometry3d flange = forward(robot.chain, q);
  const Eigen::Quaterniond turn(flange.linear());
  nlohmann::ordered_json json;
  json["frame"] = frame_word(robot.chain);
  json["position_mm"] = components_mm(flange.translation());
  json["quaternion_wxyz"] = {turn.w(), turn.x(), turn.y(), turn.z()};
  json["tool_position_mm"] = components_mm(flange * robot.chain.tool_m);
  json["robot"] = robot.name;
  json["joints"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < robot.chain.joints.size(); ++i) {
    const Joint& joint = robot.chain.joints[i];
    const std::string type = joint.endless ? "continuous" : is_revolute(joint) ? "revolute" : "prismatic";
    nlohmann::ordered_json one{{"joint", i + 1}, {"name", drawn_name(robot, i)}, {"type", type}};
    const std::string unit = unit_word(joint);
    one["at_" + unit] = border(joint, q[static_cast<Eigen::Index>(i)]);
    if (!joint.endless) one["limits_" + unit] = {border(joint, joint.lower), border(joint, joint.upper)};
    json["joints"].push_back(one);
  }
  if (!robot.masses.empty()) json["links"] = links_json(robot, inertias);
  for (const ControllerAngles& angles : controller_angles(flange.linear()))
    json["orientation"][angles.key] = angles.values;
  json["warnings"] = warnings;
  return json.dump();
}

void print_shown(const ShownRobot& shown) {
  print_joints(shown.robot);
  print_table(shown.robot);
  print_links(shown.robot, shown.inertias);
  print_pose(shown.robot, shown.joints, forward(shown.robot.chain, shown.joints));
}

}  // namespace demecal
