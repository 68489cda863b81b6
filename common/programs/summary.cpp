#include "programs/summary.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "data/text.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/configuration.hpp"

namespace demecal::inline programs {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const std::string& word, const std::vector<double>& values) {
  std::string text = fmt::format("    {:<11}", word);
  for (const double value : values) text += fmt::format(" {:>12.4f}", value);
  return text + '\n';
}

std::string heading(const TargetFigures& figures) {
  std::string text(15, ' ');
  for (std::size_t i = 0; i < figures.names.size(); ++i) {
    text += fmt::format(" {:>12}", figures.names[i] + ", " + figures.units[i]);
  }
  return text + '\n';
}

/// Whether all of the target's correction was left out, since the calibration does not determine it.
bool is_left_undetermined(const CorrectedTarget& target) {
  return target.is_as_programmed() && !target.left.empty();
}

/// "line 12", or "FILE:12" of a program of several files.
std::string place_text(const Program& program, const Target& target) {
  return program.further.empty() ? fmt::format("line {}", target.place.line)
                                 : fmt::format("{}:{}", program.file_name(target.place.file), target.place.line);
}

std::string block(const Program& program, const Target& target, const CorrectedTarget& corrected, const Chain& arm,
                  std::string& last_heading) {
  std::string text = "  " + place_text(program, target) + (target.name.empty() ? "" : ": " + target.name);
  if (corrected.is_uncorrected()) return text + ": left as it is\n";
  const TargetFigures figures = target_figures(target, corrected, arm);
  text += fmt::format(": moved {:.4f} mm, turned {:.4f} deg", figures.moved_mm, figures.turned_deg);
  if (corrected.error95_m)
    text += fmt::format(", {} within ± {:.3f} mm (k = 2)",
                        corrected.is_as_programmed() ? "left as programmed, which is reached to" : "corrected to",
                        millimetres(*corrected.error95_m));
  if (corrected.stop.payload_stated) text += fmt::format(", carrying {:g} kg", corrected.stop.payload_kg);
  text += '\n';
  const std::string names = heading(figures);
  if (names != last_heading) text += names;
  last_heading = names;
  text += row("nominal", figures.nominal) + row("corrected", figures.corrected) + row("difference", figures.difference);
  if (!corrected.widened_by.empty()) text += "    radius widened: " + joined_words(corrected.widened_by, "; ") + '\n';
  for (const std::string& direction : corrected.left) text += "    " + direction + '\n';
  return text;
}

Json entry(const Program& program, const Target& target, const CorrectedTarget& corrected, const Chain& arm) {
  Json json{{"name", target.name},
            {"file", program.file_name(target.place.file)},
            {"line", target.place.line},
            {"column", target.place.column},
            {"kind", target.is_pose() ? "pose" : "joints"},
            {"corrected_by_model", !corrected.is_uncorrected() && !is_left_undetermined(corrected)},
            {"joints_from", to_string(corrected.from)},
            {"frame", target.frames.frame.empty() ? "base" : target.frames.frame},
            {"tool", target.frames.tool ? target.frames.tool_name : "of the model"}};
  if (corrected.is_uncorrected()) return json;
  const TargetFigures figures = target_figures(target, corrected, arm);
  json["units"] = figures.units;
  json["nominal"] = figures.nominal;
  json["corrected"] = figures.corrected;
  json["difference"] = figures.difference;
  json["moved_mm"] = figures.moved_mm;
  if (corrected.error95_m) {
    json["predicted_error95_mm"] = millimetres(*corrected.error95_m);
    json["standard_uncertainty_mm"] = millimetres(*corrected.error95_m) / kCoverageFactor;
    json["coverage_factor"] = kCoverageFactor;
    json["widened_by"] = corrected.widened_by;
  }
  if (corrected.stop.payload_stated) json["payload_kg"] = corrected.stop.payload_kg;
  json["left_as_programmed"] = corrected.left;
  if (target.is_pose()) json["turned_deg"] = figures.turned_deg;
  return json;
}

constexpr std::string_view kOfWorkpiece =
    "The tool is brought to where the workpiece is drawn on its positioner; where it stands otherwise, by what the "
    "calibration found of its base, is not corrected.";

/// Where the base is that poses are counted from, for people to compare with the controller's: the height of the place
/// on axis 2 that is nearest to axis 1. Empty where no two joints turn about axes that differ in direction.
std::string base_text(const Chain& arm) {
  if (arm.positioner > 0 || arm.size() < 2 || !is_revolute(arm, 0) || !is_revolute(arm, 1)) return "";
  const auto places =
      differential_kinematics(arm, JointVector::Zero(arm.size()), arm.tool_m, PlaceMotions::Zero(6, arm.size() + 1))
          .places;
  const Eigen::Vector3d first = places[0].linear().col(2), second = places[1].linear().col(2);
  const double cosine = first.dot(second), square = 1.0 - cosine * cosine;
  if (square < 1e-6) return "";
  const Eigen::Vector3d apart = places[0].translation() - places[1].translation();
  const double along = (second.dot(apart) - cosine * first.dot(apart)) / square;
  const double height_m = places[1].translation().z() + along * second.z();
  return fmt::format(
      "Poses are counted from the base of the robot's description, in which axis 2 is at z = {:.1f} mm; the "
      "controller must count from there, too.",
      millimetres(height_m));
}

/// From where joints and poses are taken to count, a sentence each.
std::vector<std::string> notes_of(const CorrectedProgram& corrected, const Chain& arm) {
  std::vector<std::string> notes{corrected.program.joint_counting};
  if (arm.positioner > 0) notes.emplace_back(kOfWorkpiece);
  bool poses = false;
  for (std::size_t i = 0; i < corrected.targets.size(); ++i)
    poses = poses || (corrected.program.targets[i].is_pose() && !corrected.targets[i].is_uncorrected());
  if (poses) notes.push_back(base_text(arm));
  std::erase(notes, "");
  return notes;
}

}  // namespace

TargetFigures target_figures(const Target& target, const CorrectedTarget& corrected, const Chain& arm) {
  TargetFigures figures;
  const auto add = [&](const std::string& name, const std::string& unit, double nominal, double command) {
    figures.names.push_back(name);
    figures.units.push_back(unit);
    figures.nominal.push_back(nominal);
    figures.corrected.push_back(command);
    figures.difference.push_back(command - nominal);
  };
  for (int joint = 0; joint < arm.size() && !target.is_pose(); ++joint) {
    const bool revolute = is_revolute(arm, joint);
    const UnitConversion to_border = revolute ? degrees : millimetres;
    add("q" + std::to_string(joint + 1), revolute ? "deg" : "mm", to_border(corrected.nominal[joint]),
        to_border(corrected.command[joint]));
  }
  const Eigen::Isometry3d frame_from_base = target.frames.base_from_frame.inverse();
  const Eigen::Vector3d nominal_m = frame_from_base * corrected.nominal_tool.translation();
  const Eigen::Vector3d command_m = frame_from_base * corrected.command_tool.translation();
  for (int axis = 0; axis < 3 && target.is_pose(); ++axis) {
    add(std::string(1, static_cast<char>('x' + axis)), "mm", millimetres(nominal_m[axis]),
        millimetres(command_m[axis]));
  }
  const PoseError moved = pose_error(corrected.nominal_tool, corrected.command_tool);
  figures.moved_mm = millimetres(moved.head<3>().norm());
  figures.turned_deg = degrees(moved.tail<3>().norm());
  return figures;
}

MovedFigures moved_figures(const CorrectedProgram& corrected) {
  MovedFigures figures;
  for (const CorrectedTarget& target : corrected.targets) {
    if (target.is_uncorrected() || is_left_undetermined(target)) {
      ++(target.is_uncorrected() ? figures.uncorrected : figures.undetermined);
      continue;
    }
    const double moved_mm = 1e3 * (target.command_tool.translation() - target.nominal_tool.translation()).norm();
    figures.mean_mm += moved_mm;
    figures.max_mm = std::max(figures.max_mm, moved_mm);
    ++figures.targets;
  }
  if (figures.targets > 0) figures.mean_mm /= figures.targets;
  return figures;
}

std::string summary_table(const CorrectedProgram& corrected, const Chain& arm) {
  std::string text, last_heading;
  for (std::size_t i = 0; i < corrected.targets.size(); ++i) {
    text += block(corrected.program, corrected.program.targets[i], corrected.targets[i], arm, last_heading);
  }
  const MovedFigures figures = moved_figures(corrected);
  text += counted(static_cast<std::size_t>(figures.targets), "target") + " corrected";
  if (figures.targets > 0)
    text +=
        fmt::format("; the tool is moved by {:.4f} mm in the mean, {:.4f} mm at most", figures.mean_mm, figures.max_mm);
  if (figures.undetermined > 0)
    text += fmt::format("; {} left as programmed, since the calibration does not determine what to correct there",
                        figures.undetermined);
  const std::size_t left = static_cast<std::size_t>(figures.uncorrected) + corrected.program.uncorrected.size();
  if (left > 0) text += fmt::format("; {} left as they are", left);
  text += '\n';
  for (const std::string& note : notes_of(corrected, arm)) text += note + '\n';
  return text;
}

std::string summary_json(const CorrectedProgram& corrected, const Chain& arm) {
  const MovedFigures figures = moved_figures(corrected);
  Json json{{"program", corrected.program.file},
            {"language", corrected.program.language},
            {"targets", Json::array()},
            {"moved_mm", {{"mean", figures.mean_mm}, {"max", figures.max_mm}}},
            {"left", static_cast<std::size_t>(figures.uncorrected + figures.undetermined) +
                         corrected.program.uncorrected.size()},
            {"notes", notes_of(corrected, arm)},
            {"warnings", Json::array()}};
  for (std::size_t i = 0; i < corrected.targets.size(); ++i) {
    json["targets"].push_back(entry(corrected.program, corrected.program.targets[i], corrected.targets[i], arm));
  }
  for (const Remark& warning : corrected.warnings) {
    json["warnings"].push_back({{"file", corrected.program.file_name(warning.place.file)},
                                {"line", warning.place.line},
                                {"column", warning.place.column},
                                {"name", warning.name},
                                {"sentence", warning.sentence}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string warning_text(const CorrectedProgram& corrected, const Remark& warning) {
  const std::string line = warning.place.line > 0 ? fmt::format(":{}", warning.place.line) : "";
  return fmt::format("{}{}: {}{}\n", corrected.program.file_name(warning.place.file), line,
                     warning.name.empty() ? "" : warning.name + ": ", warning.sentence);
}

}  // namespace demecal::inline programs
