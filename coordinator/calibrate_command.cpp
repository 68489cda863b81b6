#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "config/job_file.hpp"
#include "coordinator/checked_data.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/dds_arguments.hpp"
#include "coordinator/dds_fleet.hpp"
#include "coordinator/interrupt.hpp"
#include "coordinator/job_identity.hpp"
#include "coordinator/result_folder.hpp"
#include "errors/input_error.hpp"
#include "terminal/report_text.hpp"

namespace demecal {
namespace {

struct CalibrateRequest {
  std::string job_file, out, resume, data_file, method;
  FleetArguments fleet;
  std::optional<std::uint64_t> seed;
  std::optional<int> max_effects;
  double worker_timeout_s = 30.0;
  bool quiet = false, asynchronous = false, force = false;
};

Job job_of(const CalibrateRequest& request) {
  Job job = load_job(request.job_file);
  if (request.seed) job.seed = *request.seed;
  if (request.max_effects) job.closed_loop.max_effects = *request.max_effects;
  if (!request.data_file.empty()) job.data_file = request.data_file;
  for (const Method method : {Method::direct, Method::distal, Method::structural}) {
    if (request.method == to_string(method)) job.method = method;
  }
  return job;
}

void print_head(const CalibrateRequest& request, const Job& job, const DataSet& data) {
  if (request.quiet) return;
  if (job.method == Method::structural) {
    fmt::print(stderr, "{}: {} on {} ({} poses), a search for transforms between the links, seed {}\n", job.name,
               data.robot.name, data.name, data.poses.size(), job.seed);
    return;
  }
  fmt::print(stderr, "{}: {} on {} ({} poses), {} islands a joint, seed {}\n", job.name, data.robot.name, data.name,
             data.poses.size(), job.islands.per_joint, job.seed);
  fmt::print(stderr, "  DDS domain {}, {}\n", request.fleet.dds->domain,
             request.fleet.workers > 0 ? fmt::format("{} local workers", request.fleet.workers)
                                       : fmt::format("waiting up to {:g} s for workers", request.worker_timeout_s));
}

/// The journal of the run in its folder of results.
std::unique_ptr<RunJournal> open_journal(const CalibrateRequest& request, const Job& job, const DataSet& data) {
  const auto start = request.resume.empty() ? RunJournal::Start::anew : RunJournal::Start::resume;
  const JobIdentity identity = identity_of(request.job_file, job, data, request.asynchronous);
  auto journal = std::make_unique<RunJournal>(request.out, identity, start);
  if (!request.quiet && !journal->found().empty()) fmt::print(stderr, "  {}\n", journal->found());
  return journal;
}

/// How to go on after a run that did not come to its end.
std::string resuming(const CalibrateRequest& request) {
  return fmt::format("`demecal calibrate {} --resume {}`, with the same options, goes on from there", request.job_file,
                     request.out);
}

/// A full disk is no fault of the user's input, and the journal still has what was reached.
Report write(const CalibrateRequest& request, const DataSet& data, const CalibrateResult& result) {
  try {
    return write_results(request.out, data, result);
  } catch (const InputError& error) {
    throw std::runtime_error(fmt::format("{}; {}", error.what(), resuming(request)));
  }
}

std::string effort(const Job& job, const RunFacts& facts) {
  if (job.method == Method::structural)
    return fmt::format("{} structures fitted in {:.1f} s", facts.evaluations, facts.wall_s);
  return fmt::format("{} islands on {} workers, {} evaluations in {:.1f} s", facts.islands, facts.workers,
                     facts.evaluations, facts.wall_s);
}

ExitCode run(CalibrateRequest request) {
  if (request.out.empty()) request.out = request.resume;
  if (request.out.empty() || (!request.resume.empty() && !same_folder(request.out, request.resume))) {
    fmt::print(stderr,
               "--out is missing, or names another folder than --resume: a resumed run leaves its results there\n");
    return ExitCode::wrong_arguments;
  }
  const Job job = job_of(request);
  const CheckedData checked = load_checked(job.data_file);
  const DataSet& data = checked.data;
  std::vector<std::string> files = result_files(job.method);
  files.emplace_back("events.jsonl");
  make_writable(request.out, files, request.force);
  if (refuses(checked, request.force)) {
    write_refusal(request.out, job.name, checked);
    return ExitCode::contradiction;
  }
  print_head(request, job, data);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  const auto make_fleet = [&] { return std::make_unique<DdsFleet>(*request.fleet.dds, request.fleet.workers); };
  CalibrateOptions options;
  options.quiet = request.quiet;
  options.asynchronous = request.asynchronous;
  options.patience.worker = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * request.worker_timeout_s));
  const std::unique_ptr<RunJournal> journal = open_journal(request, job, data);
  options.journal = journal.get();
  const FilesBeingWritten events(request.out, {"events.jsonl"});
  Chronicle chronicle(request.out, !request.resume.empty(), job.name,
                      join_dds(*request.fleet.dds, Role::herald, "chronicle"));
  options.chronicle = &chronicle;
  CalibrateResult result = fit_or_report(request.out, job.name, checked,
                                         [&] { return calibrate(data, job, make_fleet, interrupt, options); });
  result.check = checked.check;
  const RunEnd end = result.end;
  if (end == RunEnd::no_worker) {
    chronicle.ends(LoopNews::Stage::failed, "failed: no worker came");
    fmt::print(stderr,
               "no worker for {:g} s: start `demecal-worker --domain {}`, or leave --workers at its default; {}\n",
               request.worker_timeout_s, request.fleet.dds->domain, resuming(request));
    return ExitCode::no_worker;
  }
  const Report report = write(request, data, result);
  if (end == RunEnd::interrupted) {
    chronicle.ends(LoopNews::Stage::interrupted, "interrupted");
  } else {
    chronicle.ends(LoopNews::Stage::finished, "finished");
  }
  fmt::print("{}\n  {}\n  {}: {}/model.yaml, report.json, report.html{}\n", to_terminal(report),
             effort(job, result.facts), end == RunEnd::interrupted ? "interrupted; what was reached" : "results",
             request.out, job.method == Method::structural ? "" : ", history.csv");
  if (end == RunEnd::interrupted) {
    fmt::print("  {}\n", resuming(request));
    return ExitCode::interrupted;
  }
  journal->remove();
  return ExitCode::done;
}

}  // namespace

void add_calibrate(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<CalibrateRequest>();
  CLI::App* command = app.add_subcommand("calibrate", "run a calibration job and write model, report and history");
  command->add_option("job", request->job_file, "JOB.yaml")->required();
  command->add_option("--out", request->out, "folder for the results (needed, unless --resume names it)");
  command->add_option("--resume", request->resume,
                      "folder of a run that was broken off: goes on from its journal, and leaves the results there");
  command->add_option("--seed", request->seed, "seed of all randomness (default: the job's)");
  command->add_option("--method", request->method, "learning method (default: the job's)")
      ->check(CLI::IsMember({"direct", "distal", "structural"}));
  command->add_option("--max-effects", request->max_effects, "effects the closed loop may add (default: the job's)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--data", request->data_file, "data set in place of the job's");
  add_fleet_arguments(*command, request->fleet);
  command
      ->add_option("--worker-timeout-s", request->worker_timeout_s,
                   "how long to be without any worker before giving up")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--asynchronous", request->asynchronous,
                    "islands wait for no neighbour: never idle, but another run gives another result");
  command->add_flag("--quiet", request->quiet, "no progress, only the result");
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
