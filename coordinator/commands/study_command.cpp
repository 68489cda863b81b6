#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "calibration/job.hpp"
#include "config/job_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/workers.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "dds/dds_transport.hpp"
#include "errors/input_error.hpp"
#include "evolution/building_blocks.hpp"
#include "report/evaluation.hpp"
#include "scheduling/run_state.hpp"
#include "studies/study.hpp"
#include "terminal/report_text.hpp"
#include "workflows/workflows.hpp"

namespace demecal {
namespace {

constexpr int kMostSeeds = 10000;

struct StudyRequest {
  std::string job_file, grid_file, data_file, out;
  std::vector<std::string> set;
  int seeds = 6;
  std::optional<std::uint64_t> seed;
  WorkerArguments workers;
  std::size_t blocks = 12;
  bool closed_loop = false, json = false, quiet = false, force = false;
};

/// The axes of the options and of the grid file.
std::vector<GridAxis> grid_axes(const StudyRequest& request) {
  std::vector<GridAxis> axes;
  if (!request.grid_file.empty()) axes = load_grid(request.grid_file);
  for (const std::string& option : request.set) axes.push_back(read_axis(option));
  return axes;
}

Study study_of(const StudyRequest& request, const std::vector<GridAxis>& axes, const std::vector<GridCell>& cells,
               const DataSet& data) {
  Study study{.job = cells.front().job.name,
              .robot = data.robot.name,
              .data = data.name,
              .data_sha256 = data.sha256,
              .version = DEMECAL_VERSION,
              .closed_loop = request.closed_loop,
              .keys = {},
              .cells = {},
              .seeds = {},
              .runs = {},
              .blocks = {}};
  for (const GridAxis& axis : axes) study.keys.push_back(axis.key);
  for (const GridCell& cell : cells) study.cells.push_back(cell.values);
  const std::uint64_t first = request.seed.value_or(cells.front().job.seed);
  for (int i = 0; i < request.seeds; ++i) study.seeds.push_back(first + static_cast<std::uint64_t>(i));
  return study;
}

std::vector<Job> jobs_of(const StudyRequest& request, const std::vector<GridCell>& cells) {
  std::vector<Job> jobs;
  for (const GridCell& cell : cells) {
    jobs.push_back(cell.job);
    if (!request.closed_loop) jobs.back().closed_loop.max_effects = 0;
  }
  return jobs;
}

void print_progress(const Study& study, const StudyRun& run) {
  std::string cell;
  for (std::size_t i = 0; i < study.keys.size(); ++i) {
    cell += fmt::format("{} {}, ", study.keys[i], study.cells[run.cell][i]);
  }
  fmt::print(stderr, "[{}/{}] {}seed {}: {} rms {:.4f} mm, {} nodes, {:.1f} s\n", study.runs.size(),
             study.cells.size() * study.seeds.size(), cell, run.seed, run.validation_mm ? "validation" : "calibration",
             run.validation_mm.value_or(run.calibration_mm.value_or(0.0)), run.nodes, run.wall_s);
}

void write_study(const std::string& folder, const Study& study) {
  write_result(folder, "study.csv", study_csv(study));
  write_result(folder, "study.json", to_json(study, 1));
}

ExitCode print_end(const StudyRequest& request, const Study& study, RunEnd end) {
  if (request.json) {
    fmt::print("{}", to_json(study));
  } else {
    fmt::print("{}", study_table(study));
    if (request.blocks > 0) fmt::print("\n{}", blocks_table(study, request.blocks));
    fmt::print("\n{}: {}/study.csv, study.json\n", study.interrupted ? "What was reached" : "Results", request.out);
  }
  if (end == RunEnd::no_worker) {
    fmt::print(stderr, "no worker came: start `demecal-worker --domain {}`, or leave --workers at its default\n",
               request.workers.dds->domain);
    return ExitCode::no_worker;
  }
  return study.interrupted ? ExitCode::interrupted : ExitCode::done;
}

ExitCode calibrate_grid(const StudyRequest& request) {
  const std::vector<GridAxis> axes = grid_axes(request);
  const std::vector<GridCell> cells = grid_cells(request.job_file, axes);
  const Job& first = cells.front().job;
  CheckedData checked = request.data_file.empty() ? load_checked(first.data_files, first.station_tools, request.force)
                                                  : load_checked(request.data_file);
  check_declared(checked.data, first.declared, checked.check);
  if (refuses(checked, request.force, ShownFindings::all)) return ExitCode::contradiction;
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));
  const DataSet& data = checked.data;
  make_writable(request.out, {"study.csv", "study.json"}, request.force);
  Study study = study_of(request, axes, cells, data);
  CalibrateOptions options;
  const auto on_run = [&](const StudyOutcome& reached) {
    study.runs = reached.runs;
    study.interrupted = study.runs.size() < study.cells.size() * study.seeds.size();
    if (!request.quiet) print_progress(study, study.runs.back());
    write_study(request.out, study);
  };
  const StudyOutcome outcome = run_study(data, jobs_of(request, cells), study.seeds, worker_pool_maker(request.workers),
                                         watch_for_interrupt(), options, on_run);
  study.interrupted = outcome.end != RunEnd::finished;
  study.islands = outcome.fronts.size();
  study.blocks = building_blocks(outcome.fronts);
  write_study(request.out, study);
  return print_end(request, study, outcome.end);
}

/// What is wrong with an option's value is a wrong argument.
ExitCode run_or_refuse(const StudyRequest& request) {
  try {
    return calibrate_grid(request);
  } catch (const InputError& error) {
    if (!error.where().file.starts_with("--set ")) throw;
    fmt::print(stderr, "{}\n", error.what());
    return ExitCode::wrong_arguments;
  }
}

}  // namespace

void add_study(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<StudyRequest>();
  CLI::App* command = app.add_subcommand(
      "study", "calibrate with a grid of parameters and seeds: what each does to error, length and time");
  command->add_option("job", request->job_file, "JOB.yaml")->required();
  command->add_option("--out", request->out, "folder for study.csv and study.json")->required();
  command->add_option("--grid", request->grid_file, "GRID.yaml: keys of the job, each with the list of its values");
  command
      ->add_option("--set", request->set,
                   "KEY=VALUE,VALUE,... of gp, islands, distal, or method: gp.population_size=100,300")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--seeds", request->seeds, "seeds for every cell, from the job's on")
      ->check(CLI::Range(1, kMostSeeds))
      ->capture_default_str();
  command->add_option("--seed", request->seed, "the first seed (default: the job's)")->check(not_negative());
  command->add_flag("--closed-loop", request->closed_loop, "close each job's loop too, which takes much longer");
  command->add_option("--data", request->data_file, "data set in place of the job's");
  command->add_option("--blocks", request->blocks, "how many shared building blocks to print; 0: none")
      ->capture_default_str();
  command->add_flag("--json", request->json, "one line of JSON");
  add_force(*command, request->force);
  command->add_flag("--quiet", request->quiet, "no progress, only the result");
  add_worker_arguments(*command, request->workers);
  command->callback([request, &exit_code] { exit_code = run_or_refuse(*request); });
}

}  // namespace demecal
