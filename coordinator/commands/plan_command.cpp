#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/cell_file.hpp"
#include "config/job_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data/data_set.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/link_inertias.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/planned_files.hpp"
#include "drafting/planned_programs.hpp"
#include "effects/catalogue.hpp"
#include "errors/input_error.hpp"
#include "html/page.hpp"
#include "kinematics/chain.hpp"
#include "languages/languages.hpp"
#include "parameters/declared_model.hpp"
#include "parsed_programs/language.hpp"
#include "planning/cell.hpp"
#include "planning/plan.hpp"
#include "studies/plan_report.hpp"
#include "terminal/report_text.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal {
namespace {

struct PlanCommand {
  std::string robot_file, out, cell_file, after;
  std::vector<std::string> declared, detect;
  std::optional<int> poses, validation, accept, contacts;
  std::optional<double> accuracy_mm;
  std::uint64_t seed = 1;
  bool json = false, force = false;
};

struct NamedText {
  std::string name, text;
};

/// A single target that the cell states is the ball.
void take_ball(const PlanCommand& command, PlanRequest& request) {
  if (request.tools_m.size() > 1)
    throw InputError({command.cell_file, 0}, "tools_mm", "states several targets: a single ball touches the sockets");
  if (request.tools_m.empty()) return;
  request.robot.chain.tool_m = request.tools_m.begin()->second;
  request.tools_m.clear();
}

PlanRequest plan_request(const PlanCommand& command) {
  PlanRequest request;
  request.robot = load_robot(command.robot_file);
  if (request.robot.chain.positioner > 0)
    throw InputError({command.robot_file, 0}, "positioner",
                     "moves the workpiece before the arm: such poses are not planned; plan for the arm alone, "
                     "described without it");
  if (!command.declared.empty()) request.declared = declared_model(command.declared);
  request.declared.registration = true;
  request.detect = command.detect;
  request.poses = command.poses;
  if (command.accuracy_mm) request.accuracy_m = 1e-3 * *command.accuracy_mm;
  request.validation = command.validation;
  request.accept = command.accept;
  request.places = command.contacts;
  request.seed = command.seed;
  if (!command.cell_file.empty()) {
    CellFile file = load_cell(command.cell_file, request.robot);
    request.cell = std::move(file.cell);
    request.tools_m = std::move(file.tools_m);
    request.stated = std::move(file.stated);
  }
  if (request.places) take_ball(command, request);
  if (request.places && !command.after.empty())
    throw ArgumentError("--contacts and --after exclude each other: a plan goes on from measured points alone");
  if (!command.after.empty()) {
    request.measured = load_data_set(command.after);
    require_positions(*request.measured, "plan --after");
    const std::string difference = first_difference(request.robot.chain, request.measured->robot.chain);
    if (!difference.empty())
      throw InputError({command.after, 0}, request.measured->robot.name,
                       "is not the arm that is planned for (" + request.robot.name + "): " + difference +
                           "; plan for the arm that was measured");
  }
  return request;
}

/// The data set that the plan goes on from, as JOB.yaml names it; empty where there is none.
std::filesystem::path measured_file(const PlanCommand& command) {
  if (command.after.empty()) return {};
  return std::filesystem::proximate(std::filesystem::absolute(command.after), std::filesystem::absolute(command.out));
}

std::vector<NamedText> files_of(const Plan& plan, const PlanRequest& request, const PlanCommand& command) {
  std::vector<NamedText> files{
      {"poses.csv", planned_poses_csv(plan, request)},
      {"DATASET.yaml", planned_data_set_text(plan, request)},
      {"JOB.yaml", planned_job_text(request, measured_file(command))},
      {"robot.yaml", yaml_comment("the robot that was planned for, nominal") + "demecal_robot: 1\n" +
                         robot_text(request.robot, load_link_inertias(command.robot_file))},
      {"plan.html", plan_html(plan, request)}};
  for (const Language& language : all_languages()) {
    std::string text = planned_program(plan, request.robot.chain, language);
    if (text.empty()) continue;
    files.push_back({"program." + std::string(written_ending(language)), std::move(text)});
    if (std::string beside = planned_program_beside(plan, language); !beside.empty())
      files.push_back({"program." + std::string(language.written_beside), std::move(beside)});
  }
  return files;
}

ExitCode run_plan(const PlanCommand& command) {
  if (command.poses && command.accuracy_mm)
    throw ArgumentError("--poses and --accuracy exclude each other: state one of them");
  const PlanRequest request = plan_request(command);
  const Plan plan = make_plan(request);
  std::vector<NamedText> files = files_of(plan, request, command);
  if (const std::string left_out = programs_left_out(plan, request.robot.chain); !left_out.empty())
    fmt::print(stderr, "{}: {}\n", command.robot_file, left_out);
  std::vector<std::string> names;
  for (const NamedText& file : files) names.push_back(file.name);
  names.emplace_back("plan.json");
  files.push_back({"plan.json", to_json(plan, request, names)});
  make_writable(command.out, names, command.force);
  for (const NamedText& file : files) write_result(command.out, file.name, file.text);
  if (command.json) {
    fmt::print("{}", files.back().text);
  } else {
    fmt::print("{}  {}: {}\n", to_terminal(plan, request), command.out, fmt::join(names, ", "));
  }
  return ExitCode::done;
}

CLI::Validator listed_words(std::vector<std::string> words) {
  return {[words = std::move(words)](const std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end()) return {};
            return fmt::format("'{}' is none of: {}", word, fmt::join(words, " "));
          },
          ""};
}

}  // namespace

void add_plan(CLI::App& app, ExitCode& exit_code) {
  constexpr int kMost = 1000, kMostPlaces = 12;
  const auto request = std::make_shared<PlanCommand>();
  CLI::App* command = app.add_subcommand("plan", "which poses to measure, before the first one is");
  command->add_option("robot", request->robot_file, "ROBOT.yaml")->required();
  command->add_option("--out", request->out, "folder for poses, data set, job, robot programs and page")->required();
  command
      ->add_option("--poses", request->poses,
                   "N poses for calibration; those for validation and acceptance come on top")
      ->check(CLI::Range(1, kMost));
  command->add_option("--accuracy", request->accuracy_mm, "MM: the fewest poses predicted to leave so much (rms)")
      ->check(above_zero());
  command
      ->add_option("--declare", request->declared,
                   "LIST of what the model will contain, registration always (default: "
                   "registration,tool,joint_offset,geometry)")
      ->delimiter(',')
      ->check(listed_words(declared_words()));
  const auto kinds = effect_kinds();
  command->add_option("--detect", request->detect, "LIST of kinds of effects that the poses shall tell apart besides")
      ->delimiter(',')
      ->check(listed_words({kinds.begin(), kinds.end()}));
  command->add_option("--cell", request->cell_file, "CELL.yaml: room for the arm, instrument, targets, noise");
  command
      ->add_option("--contacts", request->contacts,
                   "N places of sockets that a ball on the tool touches, where no instrument measures; one more is for "
                   "accept poses")
      ->check(CLI::Range(1, kMostPlaces));
  command->add_option("--after", request->after, "DATASET.yaml of a measurement that the plan goes on from");
  command
      ->add_option("--validation", request->validation,
                   "poses for validation (default: 3 for 10, 10 at least, those of --after included)")
      ->check(CLI::Range(0, kMost));
  command->add_option("--accept", request->accept, "poses for acceptance (default: the same)")
      ->check(CLI::Range(0, kMost));
  command->add_option("--seed", request->seed, "seed of all randomness")->check(not_negative())->capture_default_str();
  command->add_flag("--json", request->json, "print plan.json in place of the summary");
  command->add_flag("--force", request->force,
                    "overwrite files that demecal did not write, or that were changed since");
  command->callback([request, &exit_code] { exit_code = run_plan(*request); });
}

}  // namespace demecal
