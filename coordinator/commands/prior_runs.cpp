#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "coordinator/commands.hpp"
#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "errors/input_error.hpp"
#include "parameters/declared_model.hpp"
#include "report/make_report.hpp"
#include "trials/finding.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/model_file.hpp"
#include "coordinator/displays.hpp"
#include "coordinator/event_log.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/workers.hpp"
#include "report/report.hpp"
#include "terminal/report_text.hpp"
#include "terminal/text.hpp"
#include "updating/learned_drift.hpp"
#include "workflows/workflows.hpp"

namespace demecal {

ExitCode run_with_prior(PriorRun run) {
  std::vector<NamedModel> models;
  for (const std::string& file : run.prior_files) models.push_back({file, load_model(file)});
  require_models_of_one_robot(models);
  const CalibratedModel& prior = models.front().model;
  const CheckedData checked = load_checked(run.job.data_files, run.job.station_tools, run.force);
  const DataSet& data = checked.data;
  if (!run.declared_stated) run.job.declared = prior.declared;
  run.job.declared.registration = run.job.declared.tool = true;
  run.job.method = Method::diagnose;
  std::vector<std::string> files = result_files(Method::diagnose);
  files.emplace_back(kEventFile);
  make_writable(run.out, files, run.force);
  if (refuses(checked, run.force, ShownFindings::ten)) {
    write_refusal(run.out, run.job.name, checked);
    return ExitCode::contradiction;
  }
  const std::atomic<bool>& interrupt = watch_for_interrupt();
  LoopDisplay display(stderr, data.robot, run.quiet);
  const std::string beginning = prior.fleet
                                    ? fmt::format("the mean of {} robots of its type", prior.fleet->robots.size())
                                    : fmt::format("the model of {} ({})", prior.job, prior.data_name);
  display.say(fmt::format("{} on {}: {} poses, beginning with {}, declared: {}", data.robot.name, data.name,
                          data.poses.size(), beginning, fmt::join(run.job.declared.words(), ", ")));
  const FilesBeingWritten events(run.out, {kEventFile});
  EventLog event_log(run.out, false, run.job.name, join_as_reporter(run.workers));
  CalibrateResult result = fit_or_report(run.out, run.job.name, checked, [&] {
    const auto watch = [&](const Round& round) {
      display.on_round(round);
      event_log.on_round(round, data.robot);
      return !interrupt;
    };
    return update_model(data, run.job, models.front(), watch, {models.begin() + 1, models.end()});
  });
  result.check = checked.check;
  const Report report = write_results(run.out, data, result);
  const bool is_interrupted = result.end == RunEnd::interrupted;
  event_log.finish(report, is_interrupted);
  const ExitCode end = is_interrupted ? ExitCode::interrupted : ExitCode::done;
  if (run.json) {
    fmt::print("{}", to_json(report));
    return end;
  }
  fmt::print("{}\n", to_terminal(report));
  for (const std::string& remark : result.remarks) fmt::print("{}\n", wrapped("  ", remark, 4));
  fmt::print("  {:.1f} s; {}: {}/model.yaml, report.json, report.html\n", result.facts.wall_s,
             is_interrupted ? "interrupted; what was reached" : "results", run.out);
  return end;
}

}  // namespace demecal
