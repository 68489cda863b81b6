#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/displays.hpp"
#include "coordinator/event_log.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/workers.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "diagnosis/outcome.hpp"
#include "drafting/planned_files.hpp"
#include "effect_sets/set_island.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "fitting/stations.hpp"
#include "next_measurement/next_measurement.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "residuals/diagnosed_model.hpp"
#include "scheduling/run_state.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"

namespace demecal {
namespace {

struct DiagnoseRequest {
  std::vector<std::string> data_files;
  std::string model_file, out;
  std::vector<std::string> prior_files;
  std::vector<std::string> declared;
  std::uint64_t seed = 1;
  ClosedLoopOptions loop;
  int proposed = 0;
  bool json = false, quiet = false, force = false, no_evolution = false;
};

/// Each word of a list must be one of `words`.
CLI::Validator one_of(std::vector<std::string> words) {
  const auto fault = [words = std::move(words)](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return {};
    return fmt::format("'{}' is none of: {}; the nearest is '{}'", word, fmt::join(words, " "),
                       nearest_name(word, words));
  };
  return {fault, ""};
}

DeclaredModel declared_by(const DiagnoseRequest& request, const std::optional<CalibratedModel>& known,
                          const DataSet& data) {
  DeclaredModel declared = known ? known->declared : declared_by_default(data);
  if (!request.declared.empty()) declared = declared_model(request.declared);
  declared.registration = has_instrument(data) || !has_contacts(data);
  return declared;
}

/// Where links are left out for want of poses, what they make wrong would be laid at other doors.
bool names_no_causes(const DiagnoseRequest& request, const DeclaredModel& declared) {
  return request.declared.empty() && request.model_file.empty() && request.prior_files.empty() && !declared.geometry &&
         request.loop == ClosedLoopOptions{};
}

Job diagnosis_job(const DiagnoseRequest& request, const DeclaredModel& declared) {
  Job job;
  job.name = std::filesystem::path(request.data_files.front()).stem().string();
  job.data_files = request.data_files;
  job.method = Method::diagnose;
  job.seed = request.seed;
  job.declared = declared;
  job.closed_loop = request.loop;
  if (request.no_evolution) job.explanations.variations = 0;
  if (names_no_causes(request, declared)) job.closed_loop.max_effects = 0;
  return job;
}

/// A diagnosis is recorded, and opens no socket.
WorkerArguments nobody_listens() {
  return {.count = 0, .in_process = true, .dds = {}};
}

/// The poses that would teach most, in a file beside the results.
void write_proposed(const DiagnoseRequest& request, const DataSet& data, const Diagnosis& diagnosis) {
  const DiagnosisProblem problem{data, diagnosis.result.model.declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  const std::vector<Stop> stops =
      propose_poses(problem, diagnosis.model, ambiguous_effects(diagnosis.result.loop.rounds), request.proposed,
                    RandomStream{request.seed, number_of(RandomPurpose::proposed_poses)});
  write_result(request.out, "proposed.csv", proposed_poses_csv(request.data_files.front(), data, stops));
}

ExitCode run_diagnose(const DiagnoseRequest& request) {
  if (!request.prior_files.empty()) {
    return run_with_prior({.prior_files = request.prior_files,
                           .out = request.out,
                           .job = diagnosis_job(request, declared_model(request.declared)),
                           .declared_stated = !request.declared.empty(),
                           .workers = nobody_listens(),
                           .json = request.json,
                           .quiet = request.quiet,
                           .force = request.force});
  }
  const CheckedData checked = load_checked(request.data_files, StationTools::own, request.force);
  const DataSet& data = checked.data;
  if (request.proposed > 0) require_instrument(data, "--propose");
  std::optional<CalibratedModel> known;
  if (!request.model_file.empty()) known = load_model(request.model_file);
  if (known) require_one_robot(*known, request.model_file, "--model");
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  std::vector<std::string> files = result_files(Method::diagnose);
  files.emplace_back(kEventFile);
  if (request.proposed > 0) files.emplace_back("proposed.csv");
  make_writable(request.out, files, request.force);
  const Job job = diagnosis_job(request, declared_by(request, known, data));
  if (refuses(checked, request.force, ShownFindings::ten)) {
    write_refusal(request.out, job.name, checked);
    return ExitCode::contradiction;
  }
  LoopDisplay display(stderr, data.robot, request.quiet);
  if (request.declared.empty() && !known && !job.declared.geometry) {
    const bool silent = names_no_causes(request, job.declared);
    fmt::print(stderr, "too few poses to declare more than {}{}; --declare LIST decides otherwise\n",
               fmt::join(job.declared.words(), ", "),
               silent ? ", or to tell other causes from the links': none is looked for" : "");
  }
  display.say(fmt::format("{} on {}: {} poses, declared: {}", data.robot.name, data.name, data.poses.size(),
                          fmt::join(job.declared.words(), ", ")));
  const FilesBeingWritten events(request.out, {kEventFile});
  EventLog event_log(request.out, false, job.name, join_as_reporter(nobody_listens()));
  Diagnosis diagnosis = fit_or_report(request.out, job.name, checked, [&] {
    return diagnose(data, job, known, [&](const Round& round) {
      display.on_round(round);
      event_log.on_round(round, data.robot);
      return !interrupt;
    });
  });
  diagnosis.result.check = checked.check;
  const CalibrateResult& result = diagnosis.result;
  const Report report = write_results(request.out, data, result);
  event_log.finish(report, result.end == RunEnd::interrupted);
  if (request.proposed > 0) write_proposed(request, data, diagnosis);
  if (request.json) {
    fmt::print("{}", to_json(report));
  } else {
    fmt::print("{}\n  {:.1f} s; {}: {}/model.yaml, report.json, report.html{}\n", to_terminal(report),
               result.facts.wall_s, result.end == RunEnd::interrupted ? "interrupted; what was reached" : "results",
               request.out, request.proposed > 0 ? ", proposed.csv" : "");
  }
  return result.end == RunEnd::interrupted ? ExitCode::interrupted : ExitCode::done;
}

void add_loop_options(CLI::App& command, DiagnoseRequest& request) {
  const auto kinds = effect_kinds();
  command.add_option("--candidates", request.loop.candidates, "kinds of effects to consider, LIST (default: all)")
      ->delimiter(',')
      ->check(one_of({kinds.begin(), kinds.end()}));
  command.add_option("--max-effects", request.loop.max_effects, "effects that may be added")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      .add_option("--family-error", request.loop.family_error,
                  "chance of adding anything to a model that lacks nothing")
      ->check(number_from(1e-6, 0.999999))
      ->capture_default_str();
  command.add_option("--highest-ratio", request.loop.highest_ratio, "of the scan over gear harmonics")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command.add_option("--ratios", request.loop.ratios, "gear ratios beyond the scan, LIST")
      ->delimiter(',')
      ->check(above_zero());
}

}  // namespace

void add_diagnose(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<DiagnoseRequest>();
  CLI::App* command = app.add_subcommand("diagnose", "what a declared model lacks: the closed loop's statistics alone");
  command->add_option("data", request->data_files, "DATASET.yaml; several: one of each station")->required();
  command->add_option("--out", request->out, "folder for the results")->required();
  command->add_option("--model", request->model_file, "MODEL.yaml to start from, with its corrections and effects");
  command
      ->add_option("--prior", request->prior_files,
                   "MODEL.yaml of this robot, found before: believed as far as it is sure, base and tool free. Given "
                   "again for earlier models: they tell how far the robot drifts")
      ->allow_extra_args(false)
      ->excludes(command->get_option("--model"));
  command
      ->add_option("--declare", request->declared,
                   "LIST of what the model is known to contain, registration always (default: the model's own; without "
                   "one registration,tool,joint_offset,geometry)")
      ->delimiter(',')
      ->check(one_of(declared_words()));
  add_loop_options(*command, *request);
  command->add_option("--propose", request->proposed, "poses worth measuring next, to proposed.csv")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--seed", request->seed, "seed of all randomness")->check(not_negative())->capture_default_str();
  command->add_flag("--no-evolution", request->no_evolution,
                    "only leave causes out of what was added one effect after another, search for no better sets");
  command->add_flag("--json", request->json, "print report.json in place of the report for people");
  command->add_flag("--quiet", request->quiet, "no progress, only the result");
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run_diagnose(*request); });
}

}  // namespace demecal
