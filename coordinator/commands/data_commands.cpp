#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "config/scenario_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "drafting/preparation_file.hpp"
#include "errors/input_error.hpp"
#include "preparation/prepared.hpp"
#include "preparation/recorded_contacts.hpp"
#include "preparation/results.hpp"
#include "report/evaluation.hpp"
#include "report/length_entries.hpp"
#include "simulation/scenario.hpp"
#include "simulation/simulated_robot.hpp"
#include "terminal/report_text.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

constexpr double kFar_mm = 1.0;  // between a programmed point and the nominal arm's: more than rounding explains

struct PrepareRequest {
  std::string file, out, frame, robot;
  std::vector<std::string> logs;
  bool json = false, force = false;
};

/// The frame of the data set; empty: the instrument's own.
std::optional<FrameKind> frame_asked(const PrepareRequest& request, const RawMeasurements& raw,
                                     const Prepared& prepared) {
  if (request.frame == "instrument" || (request.frame.empty() && !raw.local_frame)) return std::nullopt;
  if (request.frame == "best_fit") {
    if (prepared.best_fit) return FrameKind::best_fit;
    throw InputError({request.file, 0}, request.frame,
                     "is no frame here: the measured poses are fewer than three, or on a line");
  }
  if (prepared.three_points) return FrameKind::three_points;
  throw InputError({request.file, 0}, request.frame, "is no frame here: the file has no local_frame");
}

/// The frame in which errors are stated: the data set's or, where that is the instrument's own, the best there is.
std::optional<FrameKind> frame_of_errors(std::optional<FrameKind> asked, const Prepared& prepared) {
  if (asked) return asked;
  for (const FrameKind kind : kFrameKinds) {
    if (prepared.frame(kind)) return kind;
  }
  return std::nullopt;
}

std::vector<WrittenFile> files_beside(const RawMeasurements& raw, const Prepared& prepared,
                                      std::optional<FrameKind> errors) {
  if (!errors) return {};
  std::vector<WrittenFile> files = false_targets(raw, prepared, *errors);
  files.push_back(errors_file(prepared, *errors));
  return files;
}

void warn(const PrepareRequest& request, const RawMeasurements& raw, const Prepared& prepared) {
  if (!raw.local_frame && !prepared.best_fit) {
    fmt::print(stderr, "{}: no frame joins robot and instrument, so that no errors are stated\n", request.file);
  }
  if (1e3 * prepared.programmed_from_joints_m > kFar_mm) {
    fmt::print(stderr,
               "{}: programmed poses stand up to {:.3f} mm from where the nominal robot's tool is at their joints; "
               "check that the program's tool and base are those of the robot file\n",
               request.file, 1e3 * prepared.programmed_from_joints_m);
  }
}

/// The recordings that are asked for, by options or by the file; nothing where an instrument measured.
std::optional<Recordings> recordings_asked(const PrepareRequest& request) {
  if (request.file.empty() == request.logs.empty())
    throw ArgumentError("prepare needs either a PREPARATION.yaml, or --log with --robot");
  std::optional<Recordings> recordings;
  if (!request.logs.empty()) {
    recordings = load_recordings(request.robot, {request.logs.begin(), request.logs.end()});
  } else if (const YamlNode preparation = read_preparation(request.file); names_recordings(preparation)) {
    recordings = load_recordings(preparation);
  }
  if (recordings && !request.frame.empty())
    throw ArgumentError("--frame says nothing of recordings: nothing in them is measured in a frame");
  return recordings;
}

/// Finds the contacts of recordings of joints, checks the data set and writes it with standstills.csv.
ExitCode prepare_recordings(const Recordings& recordings, const PrepareRequest& request) {
  const RecordedContacts found = find_contacts(recordings);
  const DataSet data = recorded_data_set(recordings, found);
  if (!request.json) fmt::print("{}", recorded_table(recordings, found));
  const CheckedData checked{data, check_data(data)};
  if (refuses(checked, request.force, ShownFindings::all)) return ExitCode::contradiction;
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));
  for (const std::string& sentence : {untold_lengths_sentence(data), unknown_scale_sentence(data)})
    if (!sentence.empty()) fmt::print(stderr, "  - {}\n", sentence);

  const WrittenFile standstills = standstills_file(recordings, found);
  const std::vector<std::string> names{"dataset.yaml", "poses.csv", "robot.yaml", standstills.name};
  make_writable(request.out, names, request.force);
  const FilesBeingWritten written(request.out, names);
  write_data_set(data, request.out, "Prepared from raw measurements: " + recordings.name);
  write_file(request.out + "/" + standstills.name, standstills.text);
  if (request.json)
    fmt::print("{}", recorded_json(recordings, found, names));
  else
    fmt::print("{}: {}\n", request.out, fmt::join(names, ", "));
  return ExitCode::done;
}

ExitCode run_prepare(const PrepareRequest& request) {
  if (const auto recordings = recordings_asked(request)) return prepare_recordings(*recordings, request);
  const RawMeasurements raw = load_preparation(request.file);
  for (const std::string& assumed : raw.assumed) fmt::print(stderr, "assumed: {}\n", assumed);
  const Prepared prepared = prepare_measurements(raw);
  const std::optional<FrameKind> asked = frame_asked(request, raw, prepared);
  const std::optional<FrameKind> errors = frame_of_errors(asked, prepared);
  const DataSet data = prepared_data_set(raw, prepared, asked);
  const std::vector<WrittenFile> files = files_beside(raw, prepared, errors);
  const ErrorStatistic statistic = error_statistic(raw, prepared);
  warn(request, raw, prepared);
  const CheckedData checked{data, check_data(data)};
  if (refuses(checked, request.force, ShownFindings::all)) return ExitCode::contradiction;
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));

  std::vector<std::string> names{"dataset.yaml", "poses.csv", "robot.yaml"};
  for (const WrittenFile& file : files) names.push_back(file.name);
  make_writable(request.out, names, request.force);
  const FilesBeingWritten written(request.out, names);
  write_data_set(data, request.out, "Prepared from raw measurements: " + raw.name);
  for (const WrittenFile& file : files) write_file(request.out + "/" + file.name, file.text);
  const std::string frame(asked ? to_string(*asked) : "instrument");
  if (request.json) {
    fmt::print("{}", statistic_json(statistic, raw.name, frame, names));
    return ExitCode::done;
  }
  fmt::print("{}", statistic_table(statistic, raw.name));
  fmt::print("{} rows in the frame `{}`; {}: {}\n", data.poses.size(), frame, request.out, fmt::join(names, ", "));
  if (errors && errors != asked) fmt::print("errors.csv and false targets are by the frame `{}`\n", to_string(*errors));
  return ExitCode::done;
}

struct SimulateRequest {
  std::string scenario_file, out;
  bool force = false;
};

ExitCode run_simulate(const SimulateRequest& request) {
  const Scenario scenario = load_scenario(request.scenario_file);
  const std::vector<std::string> files{"dataset.yaml", "poses.csv", "robot.yaml", "truth.yaml"};
  make_writable(request.out, files, request.force);
  const FilesBeingWritten written(request.out, files);
  const DataSet data = simulate(scenario);
  write_data_set(data, request.out, "Measured on a simulated robot: " + scenario.name);
  write_file(request.out + "/truth.yaml", "# What is true of the data set beside this file; no command reads it\n" +
                                              read_file(request.scenario_file));
  fmt::print("{}: {} poses of {} measured; data set {}/dataset.yaml, truth in {}/truth.yaml\n", scenario.name,
             data.poses.size(), data.robot.name, request.out, request.out);
  return ExitCode::done;
}

}  // namespace

void add_prepare(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<PrepareRequest>();
  CLI::App* command =
      app.add_subcommand("prepare", "raw measurements, or recordings of an arm that touches points, to a data set");
  command->add_option("preparation", request->file, "PREPARATION.yaml");
  CLI::Option* const log =
      command
          ->add_option("--log", request->logs,
                       "in its place, recordings of joints with times, as loggers and ROS write them: the arm stood "
                       "still at every touch")
          ->check(CLI::ExistingFile);
  log->needs(command->add_option("--robot", request->robot, "ROBOT.yaml of the recorded arm")
                 ->check(CLI::ExistingFile)
                 ->needs(log));
  command->add_option("--out", request->out, "folder for the data set")->required();
  command
      ->add_option("--frame", request->frame,
                   "of the data set's positions: the base by the three taught points (where there are any, unless "
                   "told otherwise), the base by the best fit of all points, or the instrument's own")
      ->check(CLI::IsMember({"three_points", "best_fit", "instrument"}));
  command->add_flag("--json", request->json, "the statistic as one line of JSON");
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run_prepare(*request); });
}

void add_simulate(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<SimulateRequest>();
  CLI::App* command =
      app.add_subcommand("simulate", "measure a simulated robot: a data set, and its truth in a file apart");
  command->add_option("scenario", request->scenario_file, "SCENARIO.yaml")->required();
  command->add_option("--out", request->out, "folder for the data set")->required();
  command->add_flag("--force", request->force,
                    "overwrite files that demecal did not write, or that were changed since");
  command->callback([request, &exit_code] { exit_code = run_simulate(*request); });
}

}  // namespace demecal
