#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/robot_comparison.hpp"
#include "coordinator/shown_robot.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "data_files/doubtful_units.hpp"
#include "data_files/link_inertias.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/templates.hpp"
#include "errors/input_error.hpp"
#include "html/arm_picture.hpp"
#include "kinematics/chain.hpp"
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
    std::erase_if(field, [](char c) { return c == '[' || c == ']'; });
    std::istringstream words(field);
    std::string word;
    if (!(words >> word)) word.clear();
    do {  // blanks may stand in place of commas
      const auto value = parse_number(word);
      if (!value)
        throw ArgumentError(
            fmt::format("--at {}: '{}' is no number; give one per joint, separated by commas", at, word));
      values.push_back(*value);
    } while (words >> word);
  }
  if (std::ssize(values) != chain.size())
    throw ArgumentError(fmt::format("--at {}: {}, but the arm has {}", at, counted(values.size(), "number"),
                                    counted(chain.joints.size(), "joint")));
  return joints_from_deg_or_mm(chain, values);
}

ExitCode run_show(const ShowOptions& options) {
  const Robot robot = load_robot(options.file);
  const std::vector<std::string> units = doubtful_units(options.file);
  for (const std::string& doubt : units) fmt::print(stderr, "{}\n", doubt);
  if (!options.compare.empty())
    return print_comparison(options.compare, robot, options.json) ? ExitCode::done : ExitCode::contradiction;
  const LinkInertias inertias = load_link_inertias(options.file);
  const JointVector q =
      options.at.empty() && robot.home.size() > 0 ? robot.home : joints_asked(options.at, robot.chain);
  ShownRobot shown{robot, inertias, q,
                   options.at.empty() ? std::vector<std::string>() : beyond_limits_sentences(robot.chain, q)};
  for (const std::string& warning : shown.warnings) fmt::print(stderr, "{}: {}\n", options.file, warning);
  shown.warnings.insert(shown.warnings.begin(), units.begin(), units.end());
  if (!options.picture.empty()) write_named(options.picture, arm_picture(robot, q), options.file, options.force);
  if (options.json) {
    fmt::print("{}\n", shown_json(shown));
    return ExitCode::done;
  }
  print_shown(shown);
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
