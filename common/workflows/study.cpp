#include "workflows/workflows.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/building_blocks.hpp"
#include "expression/tree.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/evaluation.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"
#include "scheduling/run_state.hpp"
#include "scheduling/worker_pool.hpp"
#include "studies/study.hpp"

namespace demecal::inline workflows {

StudyRun figures_of(const DataSet& data, const CalibrateResult& result) {
  const ErrorBySet errors = errors_by_set(result.model.robot, data);
  StudyRun run;
  run.calibration_mm = errors.calibration.rms_mm;
  run.validation_mm = errors.validation.rms_mm;
  if (const auto& unseen = result.calibration.unseen) run.validation_mm = unseen->after_mm;
  run.accept_mm = errors.accept.rms_mm;
  for (const JointCorrection& correction : result.model.robot.corrections) {
    if (correction.is_neutral()) continue;
    ++run.corrected;
    run.nodes += correction.formula().size();
  }
  run.evaluations = result.facts.evaluations;
  run.wall_s = result.facts.wall_s;
  return run;
}

StudyOutcome run_study(const DataSet& data, std::span<const Job> jobs, std::span<const std::uint64_t> seeds,
                       const MakeWorkerPool& make_pool, const std::atomic<bool>& interrupt,
                       const CalibrateOptions& options, const std::function<void(const StudyOutcome&)>& on_run) {
  StudyOutcome outcome;
  for (const std::uint64_t seed : seeds) {
    for (std::size_t cell = 0; cell < jobs.size(); ++cell) {
      Job job = jobs[cell];
      job.seed = seed;
      CalibrateResult result = calibrate(data, job, make_pool, interrupt, options);
      outcome.end = result.end;
      if (result.end != RunEnd::finished) return outcome;
      outcome.runs.push_back(figures_of(data, result));
      outcome.runs.back().cell = cell;
      outcome.runs.back().seed = seed;
      for (auto& [island, members] : result.fronts) outcome.fronts.push_back({island.joint, std::move(members)});
      on_run(outcome);
    }
  }
  return outcome;
}

}  // namespace demecal::inline workflows
