#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "calibration/job.hpp"
#include "config/job_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/displays.hpp"
#include "coordinator/event_log.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/workers.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_files/robot_file.hpp"
#include "dds/dds_transport.hpp"
#include "diagnosis/outcome.hpp"
#include "effect_sets/set_island.hpp"
#include "errors/input_error.hpp"
#include "parameters/declared_model.hpp"
#include "protocol/messages.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "scheduling/evolution_run.hpp"
#include "scheduling/run_journal.hpp"
#include "scheduling/run_state.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct CalibrateRequest {
  std::string job_file, out, resume, data_file, method;
  std::vector<std::string> prior_files, declared;
  WorkerArguments workers;
  std::optional<std::uint64_t> seed;
  std::optional<int> max_effects;
  double worker_timeout_s = 30.0;
  std::optional<double> share_work_from_s;
  bool quiet = false, asynchronous = false, no_evolution = false, force = false;
};

Job job_of(const CalibrateRequest& request) {
  Job job = load_job(request.job_file);
  if (request.seed) job.seed = *request.seed;
  if (request.max_effects) job.closed_loop.max_effects = *request.max_effects;
  if (!request.data_file.empty()) job.data_files = {request.data_file};
  for (const Method method : {Method::direct, Method::distal, Method::diagnose, Method::structural})
    if (request.method == to_string(method)) job.method = method;
  if (!request.declared.empty()) job.declared = declared_model(request.declared);
  if (request.no_evolution) {
    if (job.method == Method::structural)
      throw InputError({request.job_file, 0}, to_string(job.method),
                       "is a search by evolution: --no-evolution leaves nothing of that method");
    job.method = Method::diagnose;
    job.explanations.variations = 0;
  }
  return job;
}

void print_head(const CalibrateRequest& request, const Job& job, const DataSet& data) {
  if (request.quiet) return;
  const bool explains = job.method == Method::diagnose && job.explanations.variations > 0;
  const std::string how = has_islands(job.method)            ? fmt::format("{} islands a joint", job.islands.per_joint)
                          : job.method == Method::structural ? "a search for transforms between the links"
                          : explains                         ? "the closed loop, explanations evolved"
                                                             : "the closed loop without evolution";
  fmt::print(stderr, "{}: {} on {} ({} poses), {}, seed {}\n", job.name, data.robot.name, data.name, data.poses.size(),
             how, job.seed);
  if (has_islands(job.method) || explains)
    fmt::print(stderr, "  {}\n", to_string(request.workers, request.worker_timeout_s));
}

/// Which job a run is of, in hashes of all that its result is a function of. `job` is that of the file with what
/// options override in it.
JobIdentity identity_of(const std::string& job_file, const Job& job, const DataSet& data, bool asynchronous) {
  const std::string overridden = fmt::format("\n{} {}\n", to_string(job.method), job.closed_loop.max_effects);
  std::string described;
  for (const std::string& file : job.data_files) described += read_file(file);
  return {.data_sha256 = sha256(data.sha256 + described + robot_text(data.robot)),
          .job_sha256 = sha256(read_file(job_file) + overridden),
          .seed = job.seed,
          .version = DEMECAL_VERSION,
          .asynchronous = asynchronous};
}

/// Whether two paths name one folder; of folders that are missing, whether they are written alike.
bool same_folder(const std::string& a, const std::string& b) {
  std::error_code failure;
  return std::filesystem::weakly_canonical(a, failure) == std::filesystem::weakly_canonical(b, failure);
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
Report write_calibration(const CalibrateRequest& request, const DataSet& data, const CalibrateResult& result) {
  try {
    return write_results(request.out, data, result);
  } catch (const InputError& error) {
    throw std::runtime_error(fmt::format("{}; {}", error.what(), resuming(request)));
  }
}

std::string effort_text(const Job& job, const RunFacts& facts) {
  if (job.method == Method::structural)
    return fmt::format("{} structures fitted in {:.1f} s", facts.evaluations, facts.wall_s);
  const std::string sets = facts.evolved_sets == 0 ? "" : fmt::format("{} sets of effects", facts.evolved_sets);
  if (job.method == Method::diagnose)
    return fmt::format("{} evolved, {:.1f} s", sets.empty() ? "nothing was" : sets, facts.wall_s);
  return fmt::format("{} islands on {} worker{}, {} evaluations{} in {:.1f} s", facts.islands, facts.workers,
                     facts.workers == 1 ? "" : "s", facts.evaluations, sets.empty() ? "" : " and " + sets,
                     facts.wall_s);
}

/// Tells two what happens, one after the other.
class ObserverPair final : public CalibrationObserver {
 public:
  ObserverPair(CalibrationObserver& first, CalibrationObserver& second) : observers_{&first, &second} {}

  void on_run_begins(const CalibrationData& data, const std::vector<Progress>& reached, bool shown) override {
    tell(&CalibrationObserver::on_run_begins, data, reached, shown);
  }
  void on_run_ends(RunEnd end) override { tell(&CalibrationObserver::on_run_ends, end); }
  void on_workers_end() override { tell(&CalibrationObserver::on_workers_end); }
  void on_progress(const Progress& progress) override { tell(&CalibrationObserver::on_progress, progress); }
  void on_worker(const WorkerStatus& status) override { tell(&CalibrationObserver::on_worker, status); }
  void on_lost(const std::string& worker) override { tell(&CalibrationObserver::on_lost, worker); }
  void on_tick() override { tell(&CalibrationObserver::on_tick); }
  void on_learning_begins(const Robot& described) override {
    tell(&CalibrationObserver::on_learning_begins, described);
  }
  void on_round(const Round& round, const Robot& described) override {
    tell(&CalibrationObserver::on_round, round, described);
  }
  void on_message(const std::string& text) override { tell(&CalibrationObserver::on_message, text); }
  void on_structure_generation(int generation, int generations, double left) override {
    tell(&CalibrationObserver::on_structure_generation, generation, generations, left);
  }

 private:
  template <class Observer, class... Parameters>
  void tell(void (Observer::*event)(Parameters...), const std::type_identity_t<Parameters>&... arguments) {
    for (CalibrationObserver* one : observers_) (one->*event)(arguments...);
  }

  std::array<CalibrationObserver*, 2> observers_;
};

ExitCode run_calibrate(CalibrateRequest request) {
  if (!request.prior_files.empty()) {
    if (request.out.empty() || !request.resume.empty())
      throw ArgumentError("--prior needs --out, and cannot be resumed: it takes seconds");
    return run_with_prior({.prior_files = request.prior_files,
                           .out = request.out,
                           .job = job_of(request),
                           .declared_stated = !request.declared.empty(),
                           .workers = request.workers,
                           .quiet = request.quiet,
                           .force = request.force});
  }
  if (!request.resume.empty() && !std::filesystem::is_directory(request.resume))
    throw ArgumentError("--resume: there is no folder " + request.resume + "; a new run's is named by --out");
  if (!request.resume.empty() && holds_no_run(request.resume))
    throw ArgumentError("--resume: " + request.resume +
                        " holds files, but no run that was begun there; a new run's folder is named by --out");
  if (request.out.empty()) request.out = request.resume;
  if (request.out.empty()) throw ArgumentError("--out is missing: name the folder for the results");
  if (!request.resume.empty() && !same_folder(request.out, request.resume))
    throw ArgumentError("--out names another folder than --resume: a resumed run leaves its results where it was");
  const Job job = job_of(request);
  CheckedData checked = load_checked(job.data_files, job.station_tools, request.force);
  check_declared(checked.data, job.declared, checked.check);
  const DataSet& data = checked.data;
  if (job.method == Method::structural) require_instrument(data, "the method structural");
  std::vector<std::string> files = result_files(job.method);
  files.emplace_back(kEventFile);
  make_writable(request.out, files, request.force);
  if (refuses(checked, request.force, ShownFindings::ten)) {
    write_refusal(request.out, job.name, checked);
    return ExitCode::contradiction;
  }
  print_head(request, job, data);
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  CalibrateOptions options;
  options.asynchronous = request.asynchronous;
  options.share_work_from_s = request.share_work_from_s;
  options.patience.worker = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * request.worker_timeout_s));
  const std::unique_ptr<RunJournal> journal = open_journal(request, job, data);
  options.journal = journal.get();
  const FilesBeingWritten events(request.out, {kEventFile});
  EventLog event_log(request.out, !request.resume.empty(), job.name, join_as_reporter(request.workers));
  ConsoleObserver console(request.quiet);
  ObserverPair observer(console, event_log);
  options.observer = &observer;
  CalibrateResult result = fit_or_report(request.out, job.name, checked, [&] {
    return calibrate(data, job, worker_pool_maker(request.workers), interrupt, options);
  });
  result.check = checked.check;
  const RunEnd end = result.end;
  if (end == RunEnd::no_worker) {
    event_log.finish(LoopNews::Stage::failed, "failed: no worker came");
    fmt::print(stderr,
               "no worker for {:g} s: start `demecal-worker --domain {}`, or leave --workers at its default; {}\n",
               request.worker_timeout_s, request.workers.dds->domain, resuming(request));
    return ExitCode::no_worker;
  }
  const Report report = write_calibration(request, data, result);
  const bool is_interrupted = end == RunEnd::interrupted;
  event_log.finish(report, is_interrupted);
  fmt::print("{}\n  {}\n  {}: {}/model.yaml, report.json, report.html{}\n", to_terminal(report),
             effort_text(job, result.facts), is_interrupted ? "interrupted; what was reached" : "results", request.out,
             has_islands(job.method) ? ", history.csv, fronts.csv" : "");
  if (is_interrupted) {
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
  command->add_option("--seed", request->seed, "seed of all randomness (default: the job's)")->check(not_negative());
  command->add_option("--method", request->method, "learning method (default: the job's)")
      ->check(CLI::IsMember({"direct", "distal", "diagnose", "structural"}));
  command
      ->add_flag("--no-evolution", request->no_evolution,
                 "as --method diagnose, and search for no better explanations: what evolution earns is the difference")
      ->excludes("--method");
  command->add_option("--max-effects", request->max_effects, "effects the closed loop may add (default: the job's)")
      ->check(not_negative());
  command->add_option("--data", request->data_file, "data set in place of the job's");
  command
      ->add_option("--prior", request->prior_files,
                   "MODEL.yaml of this robot, found before: believed as far as it is sure, base and tool free; nothing "
                   "is evolved. Given again for earlier models: they tell how far the robot drifts")
      ->allow_extra_args(false);
  command
      ->add_option("--declare", request->declared,
                   "LIST of what the model contains, in place of the job's or, with --prior, of the prior's")
      ->delimiter(',')
      ->check(CLI::IsMember(declared_words()));
  add_worker_arguments(*command, request->workers);
  command
      ->add_option("--worker-timeout-s", request->worker_timeout_s,
                   "how long to be without any worker before giving up")
      ->check(above_zero())
      ->capture_default_str();
  command->add_flag("--asynchronous", request->asynchronous,
                    "islands wait for no neighbour: never idle, but another run gives another result");
  command
      ->add_option("--share-work", request->share_work_from_s,
                   "workers take part in scans, draws and resamplings that would take one core SECONDS or longer: the "
                   "same result")
      ->check(number_from(0.0, 3600.0));
  command->add_flag("--quiet", request->quiet, "no progress, only the result");
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run_calibrate(*request); });
}

}  // namespace demecal
