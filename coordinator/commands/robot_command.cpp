#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/robot_comparison.hpp"
#include "data/data_set.hpp"
#include "data/link_inertia.hpp"
#include "data/text.hpp"
#include "data_files/link_inertias.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/templates.hpp"
#include "errors/input_error.hpp"
#include "html/arm_picture.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct ImportOptions {
  ImportRequest urdf;
  std::string base, tip;
  bool force = false;
};

ExitCode run_import(ImportOptions options) {
  if (!options.base.empty()) options.urdf.base = options.base;
  if (!options.tip.empty()) options.urdf.tip = options.tip;
  const ImportedRobot imported = import_urdf(options.urdf);
  for (const std::string& note : imported.notes) fmt::print(stderr, "{}: {}\n", options.urdf.file, note);
  const std::filesystem::path out = options.urdf.beside;
  const std::string folder = out.has_parent_path() ? out.parent_path().string() : ".";
  make_writable(folder, {out.filename().string()}, options.force);
  write_result(folder, out.filename().string(), imported.text);
  const Robot robot = load_robot(options.urdf.beside);
  fmt::print("{}: {}, {} joints, from link {} to link {}\n", options.urdf.beside, robot.name, robot.chain.size(),
             imported.base, imported.tip);
  return ExitCode::done;
}

struct ShowOptions {
  std::string file, at, compare, picture;
  bool json = false, force = false;
};

/// The joints that --at gives, deg (mm of prismatic joints); all 0 where it is not given.
JointVector joints_asked(const std::string& at, const Chain& chain) {
  std::vector<double> values;
  if (at.empty()) return JointVector::Zero(chain.size());
  for (std::size_t begin = 0, end = 0; begin <= at.size(); begin = end + 1) {
    end = std::min(at.find(',', begin), at.size());
    std::string field = at.substr(begin, end - begin);
    std::erase_if(field, [](char c) { return c == ' ' || c == '[' || c == ']'; });
    const auto value = parse_number(field);
    if (!value)
      throw ArgumentError(
          fmt::format("--at {}: '{}' is no number; give one per joint, separated by commas", at, field));
    values.push_back(*value);
  }
  if (std::ssize(values) != chain.size())
    throw ArgumentError(fmt::format("--at {}: {} numbers, but the arm has {} joints", at, values.size(), chain.size()));
  return joints_from_deg_or_mm(chain, values);
}

double border(const Joint& joint, double value) {
  return is_revolute(joint) ? degrees(value) : millimetres(value);
}

const char* unit_word(const Joint& joint) {
  return is_revolute(joint) ? "deg" : "mm";
}

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

void print_pose(const Robot& robot, const JointVector& q, const Eigen::Isometry3d& flange) {
  std::string at;
  for (int i = 0; i < robot.chain.size(); ++i) {
    const Joint& joint = robot.chain.joints[static_cast<std::size_t>(i)];
    at += fmt::format("{}{:.6g} {}", i == 0 ? "" : ", ", border(joint, q[i]), unit_word(joint));
  }
  fmt::print("\nAt {}:\n  {:32} {}\n", at, "flange in the base frame, mm",
             displayed(components_mm(flange.translation()), 4));
  fmt::print("  {:32} {}\n", "tool point in the base frame, mm",
             displayed(components_mm(flange * robot.chain.tool_m), 4));
  fmt::print("  orientation of the flange\n");
  for (const ControllerAngles& angles : controller_angles(flange.linear())) {
    const int decimals = angles.values.size() == 4 || angles.names.ends_with("rad") ? 6 : 4;
    fmt::print("    {:30} {}\n", angles.controller + ", " + angles.names, displayed(angles.values, decimals));
  }
}

std::string pose_json(const Robot& robot, const JointVector& q, const Eigen::Isometry3d& flange,
                      const LinkInertias& inertias, const std::vector<std::string>& warnings) {
  const Eigen::Quaterniond turn(flange.linear());
  nlohmann::ordered_json json;
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

ExitCode run_show(const ShowOptions& options) {
  const Robot robot = load_robot(options.file);
  if (!options.compare.empty())
    return print_comparison(options.compare, robot, options.json) ? ExitCode::done : ExitCode::contradiction;
  const LinkInertias inertias = load_link_inertias(options.file);
  const JointVector q =
      options.at.empty() && robot.home.size() > 0 ? robot.home : joints_asked(options.at, robot.chain);
  const Eigen::Isometry3d flange = forward(robot.chain, q);
  const std::vector<std::string> warnings =
      options.at.empty() ? std::vector<std::string>() : beyond_limits_sentences(robot.chain, q);
  for (const std::string& warning : warnings) fmt::print(stderr, "{}: {}\n", options.file, warning);
  if (!options.picture.empty()) write_named(options.picture, arm_picture(robot, q), options.file, options.force);
  if (options.json) {
    fmt::print("{}\n", pose_json(robot, q, flange, inertias, warnings));
    return ExitCode::done;
  }
  print_joints(robot);
  print_table(robot);
  print_links(robot, inertias);
  print_pose(robot, q, flange);
  if (!options.picture.empty()) fmt::print("\nDrawn in {}\n", options.picture);
  return ExitCode::done;
}

void add_import(CLI::App& robot, ExitCode& exit_code) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = robot.add_subcommand("import", "a ROBOT.yaml from a URDF or an SDF");
  command->add_option("urdf", options->urdf.file, "FILE.urdf or FILE.sdf; xacro must be expanded before")->required();
  command->add_option("--out", options->urdf.beside, "ROBOT.yaml to write")->required();
  command->add_option("--base", options->base, "link that the arm begins at (default: the root link)");
  command->add_option("--tip", options->tip, "link that the arm ends at: the flange (default: the only one it can be)");
  command->add_flag("--force", options->force,
                    "overwrite a file that demecal did not write, or that was changed since");
  command->callback([options, &exit_code] { exit_code = run_import(*options); });
}

void add_show(CLI::App& robot, ExitCode& exit_code) {
  const auto options = std::make_shared<ShowOptions>();
  CLI::App* command = robot.add_subcommand("show", "an arm's joints, limits, table, and its pose at given joints");
  command->add_option("robot", options->file, "ROBOT.yaml")->required();
  command->add_option("--at", options->at,
                      "joints q1,q2,... in deg, mm where one slides (default: home_deg of the file, or all 0)");
  command
      ->add_option("--compare", options->compare,
                   "POSES.csv: joints and the positions that the controller shows for them; what of the description "
                   "does not fit is named, and the exit code is 12")
      ->excludes("--at");
  command->add_option("--picture", options->picture, "FILE.svg: the arm there, from four sides and to scale")
      ->excludes("--compare");
  add_force(*command, options->force);
  command->add_flag("--json", options->json, "one line of JSON: the pose, or the comparison");
  command->callback([options, &exit_code] { exit_code = run_show(*options); });
}

}  // namespace

void add_robot(CLI::App& app, ExitCode& exit_code) {
  CLI::App* command = app.add_subcommand("robot", "arms: import from a URDF or SDF, show, compare with a controller");
  command->require_subcommand(1);
  add_import(*command, exit_code);
  add_show(*command, exit_code);
}

}  // namespace demecal
