#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <algorithm>
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
#include "coordinator/corrected_files.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "data_files/robot_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"
#include "library/conversion.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/command_model.hpp"
#include "programs/correct_program.hpp"
#include "programs/summary.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr double kMost = 1e5;  ///< mm that robot files have a tool within, and deg or mm of joints

struct ApplyRequest {
  std::string model_file, program_file, out, language, frames_file;
  std::vector<std::string> further_files;
  bool json = false, strict = false, force = false;
  std::optional<double> payload_kg;
  std::optional<double> temperature_celsius;
  std::vector<double> tool_mm;
  std::vector<double> near, pulses_per_deg;

  bool several_files() const { return !further_files.empty(); }
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

/// The program's files, read.
std::vector<ProgramFile> program_files(const ApplyRequest& request) {
  std::vector<ProgramFile> files{{request.program_file, read_file(request.program_file)}};
  for (const std::string& file : request.further_files) files.push_back({file, read_file(file)});
  return files;
}

/// Where the corrected text of each file goes: --out or, with several files, a file of the same name in that folder.
/// Throws where two of them would be one.
std::vector<std::filesystem::path> places_of(const ApplyRequest& request) {
  if (!request.several_files()) return {request.out};
  const std::filesystem::path folder = request.out;
  std::vector<std::filesystem::path> places{folder / std::filesystem::path(request.program_file).filename()};
  for (const std::string& file : request.further_files) {
    places.push_back(folder / std::filesystem::path(file).filename());
    if (std::find(places.begin(), std::prev(places.end()), places.back()) != std::prev(places.end()))
      throw ArgumentError("--with: " + file + " has the name of another file of the program");
  }
  std::error_code none;
  if (std::filesystem::exists(folder, none) && !std::filesystem::is_directory(folder, none))
    throw ArgumentError("--out: " + request.out + " is a file; a program of several files is written into a folder");
  return places;
}

/// Throws InputError where a file of the program was corrected before.
void refuse_corrected(const std::vector<ProgramFile>& program) {
  for (const ProgramFile& file : program) {
    if (const std::optional<std::size_t> line = marked_line(file.text)) {
      throw InputError({file.name, *line}, "",
                       "says that this program was corrected already; correcting it twice makes it worse: start from "
                       "the original program");
    }
  }
}

/// What the controller keeps, by options and the robot's file.
ControllerData controller_data(const ApplyRequest& request, const Robot& robot) {
  ControllerData data;
  if (!request.frames_file.empty()) data = load_frames(request.frames_file);
  data.pulses_per_deg = request.pulses_per_deg.empty() ? robot.pulses_per_deg : request.pulses_per_deg;
  const std::size_t joints = robot.chain.joints.size();
  if (!data.pulses_per_deg.empty() && data.pulses_per_deg.size() != joints) {
    throw ArgumentError("--pulses-per-deg: " + std::to_string(data.pulses_per_deg.size()) + " numbers; this arm has " +
                        std::to_string(joints) + " joints");
  }
  if (std::count(data.pulses_per_deg.begin(), data.pulses_per_deg.end(), 0.0) > 0)
    throw ArgumentError("--pulses-per-deg: must not be zero: it is how many pulses a degree has");
  return data;
}

/// A sentence where a file that usually belongs to the program stands beside it and was not given.
std::optional<Remark> companion_left(const ApplyRequest& request, const Language& language) {
  if (request.several_files()) return std::nullopt;
  const std::filesystem::path file = request.program_file;
  std::string ending = lower_case(file.extension().string());
  for (const auto& [own, other] : language.companions) {
    if (ending != '.' + std::string(own)) continue;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(
             file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), none)) {
      const std::filesystem::path& beside = entry.path();
      if (beside.stem() != file.stem() || lower_case(beside.extension().string()) != '.' + std::string(other)) continue;
      return Remark{kWholeProgram, "",
                    beside.filename().string() +
                        " beside it, which usually belongs to the program, was not read; --with takes it in"};
    }
  }
  return std::nullopt;
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

ExitCode run_apply(const ApplyRequest& request) {
  const std::vector<std::filesystem::path> places = places_of(request);
  const ProgramSource source(program_files(request));
  for (std::size_t file = 0; file < places.size(); ++file)
    require_writable(places[file], source.files()[file], source.files(), request.force);
  const CalibratedModel calibrated = load_model(request.model_file);
  say_if_fleet(calibrated, request.model_file);
  say_if_doubtful(calibrated, request.model_file);
  const CommandModel model = command_model_of(calibrated, request);
  refuse_corrected(source.files());
  const Language& language = language_asked(request, source.files().front().text);
  ControllerData controller = controller_data(request, model.nominal);
  controller.applications = applications_beside(source, language);
  Program program = read_program(language, source, model.nominal.chain, controller);
  require_program(language, source, program);
  const CommandModel own_tool = to_command_model(calibrated);
  CorrectedProgram corrected = correct_program(source.text(), std::move(program), model,
                                               {.payload_kg = request.payload_kg,
                                                .temperature_celsius = request.temperature_celsius,
                                                .near = near_joints(request, model.nominal),
                                                .tool_given = !request.tool_mm.empty(),
                                                .own_tool = &own_tool});
  if (const std::optional<Remark> left = companion_left(request, language))
    corrected.warnings.insert(corrected.warnings.begin(), *left);
  for (const Remark& warning : corrected.warnings) fmt::print(stderr, "{}", warning_text(corrected, warning));
  const std::size_t warnings = corrected.warnings.size();
  if (request.strict && warnings > 0) {
    fmt::print(stderr, "{}: nothing was written, because of {} warning{} and --strict\n", request.program_file,
               warnings, warnings == 1 ? "" : "s");
    return ExitCode::bad_input;
  }
  write_corrected(source, corrected, language,
                  correction_mark(calibrated.version, calibrated.job, calibrated.data_sha256), places);
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
  command->add_option("--out", request->out, "the corrected program; a folder for the files of one with --with")
      ->required();
  command
      ->add_option("--with", request->further_files,
                   "FILE that belongs to the program, too, such as one with its points or tools; once for each")
      ->allow_extra_args(false);
  command->add_option(
      "--frames", request->frames_file,
      "FRAMES.yaml: user frames and tools that the controller keeps, where the program only names them");
  command
      ->add_option("--pulses-per-deg", request->pulses_per_deg,
                   "P1,P2,... of each joint, for positions in pulses; without it those of the robot's file")
      ->delimiter(',')
      ->check(number_from(-1e9, 1e9));
  command->add_option("--language", request->language, "where the file's ending and words do not say it")
      ->check(CLI::IsMember(language_names(), CLI::ignore_case));
  command->add_flag("--strict", request->strict, "write nothing where there is a warning (exit code 11)");
  command->add_flag("--force", request->force, "overwrite a file that demecal did not write");
  command
      ->add_option("--near", request->near,
                   "Q1,Q2,... joints (deg; mm where one slides) that the arm is near to where the program does not "
                   "tell; without it the robot's home_deg")
      ->delimiter(',')
      ->check(number_from(-kMost, kMost));
  command->add_flag("--json", request->json, "the summary as one line of JSON");
  command->add_option("--payload-kg", request->payload_kg, "what the tool carries, where the file does not say it")
      ->check(number_from(0.0, 1e5));
  command
      ->add_option("--temperature-celsius", request->temperature_celsius,
                   "of the arm; without it the one that the model is made for")
      ->check(number_from(-273.15, 1000.0));
  command
      ->add_option("--tool-mm", request->tool_mm,
                   "X Y Z (or X,Y,Z) of the program's tool point on the flange, where it is not the tool that was "
                   "measured; a tool that the program states comes first")
      ->delimiter(',')
      ->expected(3)
      ->check(number_from(-kMost, kMost));
  command->callback([request, &exit_code] { exit_code = run_apply(*request); });
}

}  // namespace demecal
