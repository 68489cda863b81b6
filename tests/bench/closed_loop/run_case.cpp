#include "run_case.hpp"

#include <chrono>

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

/// The loop run on a scenario and judged; what it ended with goes to `result`.
RunFigures run_on(const Scenario& scenario, const CasePlan& plan, const std::vector<Effect>& truths,
                  LoopResult& result) {
  const DataSet data = measured(scenario);
  const auto start = std::chrono::steady_clock::now();
  result = closed(data, plan);
  RunFigures figures;
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  const double floor_mm = noise_floor_mm(scenario, data);
  figures.before_over_floor = error_figures(result.before.robot, data, accept).rms_mm / floor_mm;
  figures.after_over_floor = error_figures(result.model.robot, data, accept).rms_mm / floor_mm;
  figures.final_effects = result.model.robot.effects;
  figures.rounds = result.outcome.rounds;
  figures.score =
      score(result.outcome, figures.final_effects, truths, data.robot, states_of(data, PoseSet::calibration));
  return figures;
}

}  // namespace

CaseFigures run_case(const CasePlan& plan, const Robots& robots, bool only_clean) {
  CaseFigures figures{.plan = plan, .truths = {}, .clean = {}, .run = {}};
  const Robot& robot = robots.at(plan.robot_file);
  Scenario scenario = clean_scene(plan, robot);
  LoopResult result;
  figures.clean = run_on(scenario, plan, {}, result);
  if (only_clean) return figures;
  RandomStream random{plan.seed(), kTruth};
  figures.truths = draw_truths(plan.kind, result.outcome.not_found, robot,
                               states_of(measured(scenario), PoseSet::calibration), random);
  if (figures.truths.empty()) return figures;
  for (const Effect& truth : figures.truths) inject(scenario, truth);
  figures.run = run_on(scenario, plan, figures.truths, result);
  return figures;
}

}  // namespace demecal::bench
