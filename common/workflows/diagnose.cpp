#include "explanations/error_budget.hpp"
#include "explanations/explanation_search.hpp"
#include "kinematics/forward.hpp"
#include "workflows/workflows.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closing.hpp"
#include "closed_calibration/loop_passes.hpp"
#include "closed_calibration/one_place.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "diagnosis/outcome.hpp"
#include "errors/input_error.hpp"
#include "fitting/base_search.hpp"
#include "fitting/fit.hpp"
#include "fitting/stations.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "report/make_report.hpp"
#include "residuals/diagnosed_model.hpp"
#include "scheduling/run_state.hpp"

namespace demecal::inline workflows {
namespace {

/// Whether there are so many times as many measured numbers as parameters.
bool determines(const DataSet& data, const DeclaredModel& declared, double times) {
  std::size_t measured = 0;
  for (const std::size_t pose : poses_of(data, PoseSet::calibration)) {
    measured += static_cast<std::size_t>(rows_of(data.poses[pose]).total());
  }
  return static_cast<double>(measured) >= times * static_cast<double>(free_parameters(data, declared).size());
}

Preparation start_of(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known) {
  if (!known) return prepare(data, job);
  CalibratedModel model = *known;
  model.robot = with_tools_of_stations(std::move(model.robot), data);
  require_same_nominal_arm(model, data);
  model.robot.described = data.robot;
  Preparation preparation = prepare_from(data, job.declared, model.robot, job.targets);
  preparation.corrections = job.corrections;
  return preparation;
}

}  // namespace

void require_same_arm(const CorrectedRobot& robot, const DataSet& data) {
  if (data.robot.chain.size() != robot.chain.size()) {
    throw InputError({data.file, 0}, std::to_string(data.robot.chain.size()),
                     fmt::format("is not the number of joints of the model ({})", robot.chain.size()));
  }
  for (const MeasuredPose& pose : data.poses) {
    if (!robot.tools.contains(pose.target)) {
      throw InputError({data.file, pose.line}, pose.target, "is a target that the model has no tool for");
    }
  }
}

void require_alike_arm(const CalibratedModel& model, const DataSet& data) {
  constexpr double kAnother_m = 0.02;
  require_same_arm(model.robot, data);
  double farthest_m = 0.0;
  for (const MeasuredPose& pose : data.poses) {
    const Eigen::Vector3d apart_m =
        forward(model.nominal.chain, pose.joints).translation() - forward(data.robot.chain, pose.joints).translation();
    farthest_m = std::max(farthest_m, apart_m.norm());
  }
  if (farthest_m < kAnother_m) return;
  throw InputError(
      {data.file, 0}, data.robot.name,
      fmt::format("is not the arm that the model corrects ({}): described as it is it stands up to {:.0f} mm "
                  "from there at these poses; give the model of this arm, or --force to go on",
                  model.nominal.name, 1e3 * farthest_m));
}

void require_alike_tool(const CalibratedModel& model, const DataSet& data) {
  const Eigen::Vector3d& stated_m = data.robot.chain.tool_m;
  const Eigen::Vector3d identified_m = model.robot.tool("").translation();
  if (stated_m.isZero(0.0) || (stated_m - model.nominal.chain.tool_m).norm() <= kSameTool_m ||
      (stated_m - identified_m).norm() <= kSameTool_m) {
    return;
  }
  const auto point = [](const Eigen::Vector3d& tool_m) {
    return fmt::format("{:.1f}, {:.1f}, {:.1f} mm", 1e3 * tool_m.x(), 1e3 * tool_m.y(), 1e3 * tool_m.z());
  };
  throw InputError(
      {data.file, 0}, data.robot.name,
      fmt::format("has its tool at {}, which is another than the one the model was made with: stated at {}, "
                  "identified at {}; --refit-base fits base and tool to these poses, --force judges them "
                  "with the model's tool",
                  point(stated_m), point(model.nominal.chain.tool_m), point(identified_m)));
}

void require_same_nominal_arm(const CalibratedModel& model, const DataSet& data) {
  require_same_arm(model.robot, data);
  const std::string difference = first_difference(model.nominal.chain, data.robot.chain);
  if (!difference.empty())
    throw InputError({data.file, 0}, data.robot.name, "is not the arm that the model corrects: " + difference);
}

DeclaredModel declared_by_default(const DataSet& data) {
  constexpr double kUnknown = 2.0, kKnownFromMakers = 1.02;
  const DeclaredModel links{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  if (determines(data, links, has_contacts(data) ? kUnknown : kKnownFromMakers)) return links;
  for (const DeclaredModel& declared : {DeclaredModel{.registration = true, .tool = true, .joint_offset = true},
                                        DeclaredModel{.registration = true, .tool = true}}) {
    if (determines(data, declared, kUnknown)) return declared;
  }
  return {.registration = true};
}

Diagnosis diagnose(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known,
                   const RoundWatcher& watch, const LoopWork& work) {
  const auto begin = std::chrono::steady_clock::now();
  CalibrateResult result;
  result.preparation = start_of(data, job, known);
  const auto watched = [&](const Round& round) {
    const bool go_on = !watch || watch(round);
    if (!go_on) result.end = RunEnd::interrupted;
    return go_on;
  };
  const Fit& declared = result.preparation.declared;
  LoopOptions options = loop_options(job, declared.robot.effects.size());
  options.work = work;
  LoopResult found = close_loop(data, job.declared, loop_start(data, declared, declared.robot), options, watched);
  take_back_unjudged(data, found);
  drop_negligible_terms(found.before);
  LoopModels ends{std::move(found.before),
                  with_bounded_corrections(data, job.declared, result.preparation, poses_of(data, PoseSet::calibration),
                                           std::move(found.model))};
  std::optional<LastFit> last = last_fit(data, job.declared, result.preparation, ends);
  ErrorBudget budget =
      error_budget_of(data, job.declared, ends.after, found.front, last ? last->ends.after : ends.after, job.seed);
  if (const auto best =
          calibration_of_best(data, job.declared, result.preparation, ends.before.robot, std::move(found.best)))
    result.best = make_model(data, job, *best);
  if (last) ends = std::move(last->ends);
  result.calibration = calibration_of(data, job.declared, result.preparation, ends.after);
  result.calibration.budget = std::move(budget);
  if (last) result.calibration.unseen = last->unseen;
  result.before = std::move(ends.before.robot);
  result.loop = std::move(found.outcome);
  update_rounds(result.loop, ends.after.robot, data.robot);
  result.model = make_model(data, job, result.calibration);
  result.facts.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.facts.interrupted = result.end == RunEnd::interrupted;
  return {std::move(result), std::move(ends.after)};
}

}  // namespace demecal::inline workflows
