#include "run_case.hpp"

#include <chrono>

#include "closed_calibration/calibrated_model.hpp"
#include "diagnosis/loop.hpp"
#include "draw_truth.hpp"
#include "fitting/fit.hpp"
#include "scene.hpp"
#include "truth.hpp"

namespace demecal::bench {
namespace {

constexpr std::uint64_t kTruth = 21;  ///< of the case's random streams

LoopResult closed(const DataSet& data, const CasePlan& plan) {
  const DeclaredModel& declared = row_of(plan.kind).declared;
  const Fit start = fit_declared(data, poses_of(data, PoseSet::calibration), declared, nominal_robot(data));
  LoopOptions options;
  options.seed = plan.seed();
  return close_loop(data, declared, start, options);
}

/// How many accept poses lie within the radii of the model, told while the validation poses were unseen.
void count_within(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& unseen,
                  const CorrectedRobot& model, LoopFigures& figures) {
  const PredictionInterval interval =
      prediction_interval(data, fitted_posterior(data, declared, unseen, poses_of(data, PoseSet::calibration)), unseen);
  const Posterior posterior = fitted_posterior(data, declared, model, poses_of_last_fit(data)).posterior;
  for (const std::size_t pose : poses_of(data, PoseSet::accept)) {
    const double radius_m = radius95_m(interval, posterior, model, data, data.poses[pose]);
    figures.within += tool_error_m(model, data, data.poses[pose]) <= radius_m ? 1 : 0;
    ++figures.accept;
  }
}

/// The loop run on a scenario and judged; what it ended with goes to `result`.
LoopFigures run_on(const Scenario& scenario, const CasePlan& plan, const std::vector<Effect>& truths,
                   LoopResult& result) {
  const DataSet data = measured(scenario);
  const auto start = std::chrono::steady_clock::now();
  result = closed(data, plan);
  LoopFigures figures;
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  const double floor_mm = error_of_truth_mm(scenario, data);
  const DeclaredModel& declared = row_of(plan.kind).declared;
  const DiagnosedModel before = final_fit(data, declared, result.before),
                       after = final_fit(data, declared, result.model);
  figures.before_over_floor = error_figures(before.robot, data, accept).rms_mm / floor_mm;
  figures.after_over_floor = error_figures(after.robot, data, accept).rms_mm / floor_mm;
  count_within(data, declared, result.model.robot, after.robot, figures);
  figures.final_effects = result.model.robot.effects;
  figures.rounds = result.outcome.rounds;
  figures.score =
      score(result.outcome, figures.final_effects, truths, data.robot, states_of(data, PoseSet::calibration));
  return figures;
}

/// Effects for a case by what the loop says of its clean twin.
std::vector<Effect> truths_for(const CasePlan& plan, const DataSet& clean, const LoopResult& result) {
  const DiagnosisProblem problem{clean, row_of(plan.kind).declared, poses_of(clean, PoseSet::calibration),
                                 poses_of(clean, PoseSet::validation)};
  const DetectionLimit limit(problem, result.model);
  RandomStream random{plan.seed(), kTruth};
  return draw_truths(
      plan.kind, result.outcome.not_found, clean.robot, states_of(clean, PoseSet::calibration),
      [&](const NotFound& measure, const Effect& effect) { return limit.detectable(measure, effect); }, random);
}

}  // namespace

CaseFigures run_case(const CasePlan& plan, const Robots& robots, bool only_clean) {
  CaseFigures figures{.plan = plan, .truths = {}, .clean = {}, .run = {}};
  Scenario scenario = clean_scene(plan, robots.at(plan.robot_file));
  LoopResult result;
  figures.clean = run_on(scenario, plan, {}, result);
  if (only_clean) return figures;
  figures.truths = truths_for(plan, measured(scenario), result);
  if (figures.truths.empty()) return figures;
  for (const Effect& truth : figures.truths) inject(scenario, truth);
  figures.run = run_on(scenario, plan, figures.truths, result);
  return figures;
}

}  // namespace demecal::bench
