#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "baselines/baseline.hpp"
#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/job_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/displays.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/workers.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "effects/effect.hpp"
#include "expression/simplify.hpp"
#include "expression/tree.hpp"
#include "fitting/fit.hpp"
#include "html/page.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "primitives/primitive.hpp"
#include "report/evaluation.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "scheduling/run_state.hpp"
#include "terminal/report_text.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

struct CompareRequest {
  std::string job_file, data_file, out;
  WorkerArguments workers;
  std::optional<std::uint64_t> seed;
  std::optional<int> max_effects;
  bool json = false, baselines_only = false, force = false;
};

Job compared_job(const CompareRequest& request) {
  Job job = load_job(request.job_file);
  if (request.seed) job.seed = *request.seed;
  if (request.max_effects) job.closed_loop.max_effects = *request.max_effects;
  if (!request.data_file.empty()) job.data_files = {request.data_file};
  return job;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// All but our own, each timed with the registration that it starts from.
void compare_baselines(const DataSet& data, const Job& job, Comparison& comparison) {
  for (const Baseline& baseline : all_baselines()) {
    const Clock::time_point begin = Clock::now();
    const BaselineFit fit = baseline.fit(registered_arm(data, job.declared));
    const double wall_s = seconds_since(begin);
    const std::array<ErrorFigures, 3> figures = figures_by_set(fit, data);
    comparison.methods.push_back({baseline.key,
                                  baseline.title,
                                  fit.parameters,
                                  wall_s,
                                  fit.chosen,
                                  {set_errors(figures[0]), set_errors(figures[1]), set_errors(figures[2])}});
  }
}

/// Numbers identified by least squares: of base, tools and links, and the effects' coefficients.
int fitted_in(const CalibratedModel& model) {
  int numbers = 0;
  for (const ParameterEstimate& estimate : model.estimates) {
    numbers += estimate.id.kind == ParameterId::Kind::effect ? 0 : 1;  // with the effects below
  }
  for (const Effect& effect : model.robot.effects) numbers += static_cast<int>(effect.values.size());
  return numbers;
}

/// Different constants in a formula, without what changes no value.
int constants_in(const Tree& formula) {
  std::set<double> different;
  for (const Node& node : simplified(formula)) {
    if (node.primitive == Primitive::constant) different.insert(node.value);
  }
  return static_cast<int>(different.size());
}

/// Of all evolved formulas.
int constants_in(const CalibratedModel& model) {
  int numbers = 0;
  for (const JointCorrection& correction : model.robot.corrections) {
    if (!correction.is_neutral()) numbers += constants_in(correction.formula());
  }
  for (const Effect& effect : model.robot.effects) {
    if (!effect.formula.empty()) numbers += constants_in(effect.formula);
  }
  return numbers;
}

ExitCode compare_ours(const CompareRequest& request, const DataSet& data, const Job& job, Comparison& comparison) {
  CalibrateOptions options;
  ConsoleObserver console(request.json);
  options.observer = &console;
  const CalibrateResult result =
      calibrate(data, job, worker_pool_maker(request.workers), watch_for_interrupt(), options);
  if (result.end == RunEnd::no_worker) return ExitCode::no_worker;
  if (!request.out.empty()) write_results(request.out, data, result);
  const int fitted = fitted_in(result.model), constants = constants_in(result.model);
  ComparedMethod ours;
  ours.key = "demecal";
  ours.title = "this job, closed loop and all";
  ours.error_mm = errors_by_set(result.model.robot, data);
  ours.parameters = fitted + constants;
  ours.wall_s = result.facts.wall_s;
  ours.chosen = fmt::format("{} effects; {} numbers by least squares, {} constants in formulas",
                            result.model.robot.effects.size(), fitted, constants);
  comparison.methods.push_back(std::move(ours));
  return result.end == RunEnd::interrupted ? ExitCode::interrupted : ExitCode::done;
}

ExitCode run_compare(const CompareRequest& request) {
  const Job job = compared_job(request);
  CheckedData checked = load_checked(job.data_files, job.station_tools, request.force);
  check_declared(checked.data, job.declared, checked.check);
  const DataSet& data = checked.data;
  require_instrument(data, "compare");
  std::vector<std::string> files = result_files(job.method);
  files.emplace_back("comparison.json");
  if (!request.out.empty()) make_writable(request.out, files, request.force);
  if (refuses(checked, request.force, request.out.empty() ? ShownFindings::all : ShownFindings::ten)) {
    if (!request.out.empty()) write_refusal(request.out, job.name, checked);
    return ExitCode::contradiction;
  }
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));
  Comparison comparison{job.name, data.robot.name, data.name, data.sha256, {}, {}};
  for (const MeasuredPose& pose : data.poses) ++comparison.poses[static_cast<std::size_t>(pose.set)];
  compare_baselines(data, job, comparison);
  const ExitCode code = request.baselines_only ? ExitCode::done : compare_ours(request, data, job, comparison);
  if (code == ExitCode::no_worker) {
    fmt::print(stderr, "no worker came: the table is without this job's own method\n");
  }
  if (!request.out.empty()) write_result(request.out, "comparison.json", to_json(comparison, 1));
  fmt::print("{}", request.json ? to_json(comparison) : comparison_table(comparison));
  return code;
}

}  // namespace

void add_compare(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<CompareRequest>();
  CLI::App* command =
      app.add_subcommand("compare", "fit methods of the literature to a job's poses, and the job itself: one table");
  command->add_option("job", request->job_file, "JOB.yaml")->required();
  command->add_option("--data", request->data_file, "data set in place of the job's");
  command->add_option("--out", request->out, "folder for comparison.json and this job's results");
  command->add_flag("--json", request->json, "one line of JSON");
  add_force(*command, request->force);
  command->add_flag("--baselines-only", request->baselines_only, "leave out the job itself, which takes longest");
  add_worker_arguments(*command, request->workers);
  command->add_option("--seed", request->seed, "seed of all randomness (default: the job's)")->check(not_negative());
  command->add_option("--max-effects", request->max_effects, "effects the closed loop may add (default: the job's)")
      ->check(not_negative());
  command->callback([request, &exit_code] { exit_code = run_compare(*request); });
}

void add_report(CLI::App& app, ExitCode& exit_code) {
  const auto folder = std::make_shared<std::string>();
  const auto force = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("report", "rebuild the report a person reads from a results folder");
  command->add_option("dir", *folder, "folder that calibrate or diagnose wrote")->required();
  command->add_flag("--force", *force, "overwrite a report.html that demecal did not write, or that was changed since");
  command->callback([folder, force, &exit_code] {
    const Report report = read_report(read_file(*folder + "/report.json"), "report.json");
    const std::string history = *folder + "/history.csv";  // a diagnosis leaves none
    const std::string page =
        report_html(report, read_fitness(std::filesystem::exists(history) ? read_file(history) : ""));
    make_writable(*folder, {"report.html"}, *force);
    write_result(*folder, "report.html", page);
    fmt::print("{}/report.html\n", *folder);
    exit_code = ExitCode::done;
  });
}

}  // namespace demecal
