#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"
#include "languages/program.hpp"
#include "library/conversion.hpp"
#include "programs/command_model.hpp"
#include "programs/correct_program.hpp"
#include "programs/summary.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct ApplyRequest {
  std::string model_file, program_file, out, language;
  bool json = false, strict = false, force = false;
  double payload_kg = 0.0;
  std::optional<double> temperature_celsius;
  std::vector<double> tool_mm;
  std::vector<double> near;
};

CommandModel command_model_of(const CalibratedModel& model, const ApplyRequest& request) {
  std::optional<Eigen::Vector3d> tool_m;
  if (!request.tool_mm.empty()) tool_m = 1e-3 * Eigen::Map<const Eigen::Vector3d>(request.tool_mm.data());
  CommandModel commands = to_command_model(model, tool_m);
  if (!model.posterior || model.measured.empty()) {
    commands.notes.push_back(
        request.model_file +
        " states neither how sure its numbers are nor what its joints' ranges were: directions that "
        "the calibration does not determine and targets outside its range cannot be told; calibrate "
        "again to have them");
  }
  return commands;
}

/// The joints of --near, otherwise the robot's declared home, rad and m.
JointVector near_joints(const ApplyRequest& request, const Robot& robot) {
  const Chain& arm = robot.chain;
  if (request.near.empty()) return robot.home;
  if (std::ssize(request.near) != arm.size()) {
    throw ArgumentError("--near: " + std::to_string(request.near.size()) + " numbers; this arm has " +
                        std::to_string(arm.size()) + " joints");
  }
  return joints_from_deg_or_mm(arm, request.near);
}

/// Throws unless `out` may be written: never the program itself, by whatever name; of other files those that this
/// command wrote, or any with --force.
void require_writable(const ApplyRequest& request) {
  std::error_code none;
  if (std::filesystem::equivalent(request.program_file, request.out, none) || request.program_file == request.out) {
    throw ArgumentError("--out: " + request.out + " is the program itself, which is never overwritten; name another");
  }
  if (request.force || !std::filesystem::exists(request.out, none)) return;
  if (std::filesystem::is_regular_file(request.out, none)) {
    const std::string there = read_file(request.out);
    if (marked_line(there) || there == read_file(request.program_file)) return;
  }
  throw ArgumentError("--out: " + request.out +
                      " is there already, and not a program that demecal corrected; name "
                      "another, or give --force to overwrite it");
}

/// Throws InputError where the program was corrected before.
void refuse_corrected(const ApplyRequest& request, const std::string& text) {
  const std::optional<std::size_t> line = marked_line(text);
  if (!line) return;
  throw InputError({request.program_file, *line}, "",
                   "says that this program was corrected already; correcting it twice makes it worse: start from the "
                   "original program");
}

std::vector<std::string> language_names() {
  std::vector<std::string> names;
  for (const Language& language : all_languages()) names.emplace_back(language.name);
  return names;
}

/// What `part` is of every language, separated by commas.
std::string listed_languages(std::string_view Language::*part) {
  std::string text;
  for (const Language& language : all_languages()) text += (text.empty() ? "" : ", ") + std::string(language.*part);
  return text;
}

const Language& language_asked(const ApplyRequest& request, const std::string& text) {
  const Language* const language =
      request.language.empty() ? recognize_language(text, request.program_file) : find_language(request.language);
  if (language != nullptr) return *language;
  throw InputError(
      {request.program_file, 0}, "",
      "is in no language that can be told; name it with --language (" + listed_languages(&Language::name) + ')');
}

ExitCode run(const ApplyRequest& request) {
  require_writable(request);
  const CalibratedModel calibrated = load_model(request.model_file);
  say_if_fleet(calibrated, request.model_file);
  const CommandModel model = command_model_of(calibrated, request);
  const std::string text = read_file(request.program_file);
  refuse_corrected(request, text);
  const Language& language = language_asked(request, text);
  Program program = read_program(language, text, request.program_file, model.nominal.chain);
  CorrectedProgram corrected = correct_program(text, std::move(program), model,
                                               {.payload_kg = request.payload_kg,
                                                .temperature_celsius = request.temperature_celsius,
                                                .near = near_joints(request, model.nominal),
                                                .tool_given = !request.tool_mm.empty()});
  for (const Remark& warning : corrected.warnings) fmt::print(stderr, "{}", warning_text(corrected, warning));
  const std::size_t warnings = corrected.warnings.size();
  if (request.strict && warnings > 0) {
    fmt::print(stderr, "{}: nothing was written, because of {} warning{} and --strict\n", request.program_file,
               warnings, warnings == 1 ? "" : "s");
    return ExitCode::bad_input;
  }
  const std::string mark = correction_mark(calibrated.version, calibrated.job, calibrated.data_sha256);
  const bool changed = corrected.text != text;
  write_file(request.out, changed ? with_mark(corrected.text, language, mark) : corrected.text);
  fmt::print("{}", request.json ? summary_json(corrected, model.nominal.chain)
                                : summary_table(corrected, model.nominal.chain));
  return ExitCode::done;
}

}  // namespace

void add_apply(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<ApplyRequest>();
  CLI::App* command = app.add_subcommand("apply", "correct a robot program, so that the real robot goes where it says");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command
      ->add_option("program", request->program_file,
                   "in one of " + listed_languages(&Language::title) +
                       "; poses are of the tool point in the base frame where the program states no other")
      ->required();
  command->add_option("--out", request->out, "the corrected program")->required();
  command->add_option("--language", request->language, "where the file's ending and words do not say it")
      ->check(CLI::IsMember(language_names(), CLI::ignore_case));
  command->add_flag("--strict", request->strict, "write nothing where there is a warning (exit code 11)");
  command->add_flag("--force", request->force, "overwrite a file that demecal did not write");
  command
      ->add_option("--near", request->near,
                   "Q1,Q2,... joints (deg; mm where one slides) that the arm is near to where the program does not "
                   "tell; without it the robot's home_deg")
      ->delimiter(',');
  command->add_flag("--json", request->json, "the summary as one line of JSON");
  command->add_option("--payload-kg", request->payload_kg, "what the tool carries, where the file does not say it")
      ->check(CLI::Range(0.0, 1e5));
  command
      ->add_option("--temperature-celsius", request->temperature_celsius,
                   "of the arm; without it the one that the model is made for")
      ->check(CLI::Range(-273.15, 1000.0));
  command
      ->add_option("--tool-mm", request->tool_mm,
                   "X Y Z of the program's tool point on the flange, where it is not the tool that was measured; a "
                   "tool that the program states comes first")
      ->expected(3);
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
