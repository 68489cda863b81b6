#include "coordinator/diagnose.hpp"

#include "closed_calibration/closing.hpp"
#include "closed_calibration/loop_passes.hpp"
#include "coordinator/known_arm.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

bool determines(const DataSet& data, const DeclaredModel& declared) {
  std::size_t measured = 0;
  for (const std::size_t pose : poses_of(data, PoseSet::calibration)) {
    measured += static_cast<std::size_t>(rows_of(data.poses[pose]).total());
  }
  return measured >= 2 * free_parameters(data, declared, {}).size();
}

Preparation start_of(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known) {
  if (!known) return prepare(data, job);
  require_same_nominal_arm(*known, data);
  CorrectedRobot model = known->robot;
  model.described = data.robot;
  return prepare_from(data, job.declared, model, job.targets);
}

}  // namespace

DeclaredModel declared_by_default(const DataSet& data) {
  for (const DeclaredModel& declared :
       {DeclaredModel{.registration = true, .tool = true, .joint_offset = true, .geometry = true},
        DeclaredModel{.registration = true, .tool = true, .joint_offset = true},
        DeclaredModel{.registration = true, .tool = true}}) {
    if (determines(data, declared)) return declared;
  }
  return {.registration = true};
}

Diagnosis diagnose(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known,
                   const RoundWatcher& watch) {
  const Clock::time_point begin = Clock::now();
  CalibrateResult result;
  result.preparation = start_of(data, job, known);
  const auto watched = [&](const Round& round) {
    const bool go_on = !watch || watch(round);
    if (!go_on) result.end = RunEnd::interrupted;
    return go_on;
  };
  const Fit& declared = result.preparation.declared;
  LoopResult found = close_loop(data, job.declared, loop_start(data, declared, declared.robot),
                                loop_options(job, declared.robot.effects.size()), watched);
  drop_negligible_terms(found.before);
  drop_negligible_terms(found.model);
  LoopModels ends{std::move(found.before), std::move(found.model)};
  std::optional<LastFit> last = last_fit(data, job.declared, ends);
  if (last) ends = std::move(last->ends);
  result.calibration = calibration_of(data, job.declared, result.preparation, ends.after);
  if (last) result.calibration.unseen = last->unseen;
  result.before = std::move(ends.before.robot);
  result.loop = std::move(found.outcome);
  update_rounds(result.loop, ends.after.robot, data.robot);
  result.model = model_of(data, job, result.calibration);
  result.facts.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  return {std::move(result), std::move(ends.after)};
}

}  // namespace demecal
