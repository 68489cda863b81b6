#include "evolution_case.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "calibration/job.hpp"
#include "closed_loop/case_plan.hpp"
#include "closed_loop/draw_truth.hpp"
#include "closed_loop/scene.hpp"
#include "closed_loop/truth.hpp"
#include "diagnosis/loop.hpp"
#include "prediction/measurement.hpp"
#include "simulation/scenario.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

constexpr std::uint64_t kFirstSeed = 20261200;
constexpr std::uint64_t kTruth = 22;  ///< of an arm's random streams

/// "backlash (from 3), joint 5"
std::string name_of(const Effect& effect) {
  std::string name = effect.kind;
  for (const auto& [setting, value] : effect.settings) name += fmt::format(" ({} {})", setting, value);
  if (!effect.form.empty()) name += " (" + effect.form + ")";
  return fmt::format("{}, joint {}", name, effect.joint + 1);
}

DiagnosisFigures diagnosed(const DataSet& data, const DeclaredModel& declared, std::uint64_t seed, bool evolve,
                           const std::vector<Effect>& truths) {
  Job job;
  job.name = data.name;
  job.method = Method::diagnose;
  job.declared = declared;
  job.seed = seed;
  if (!evolve) job.explanations.variations = 0;
  const auto begin = std::chrono::steady_clock::now();
  const CalibrateResult result = diagnose(data, job, std::nullopt, {}).result;
  DiagnosisFigures figures;
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.front = result.calibration.budget.front;
  figures.causes = result.calibration.budget.causes.size();
  const CorrectedRobot& robot = result.model.robot;
  figures.effects = robot.effects.size();
  figures.validation_mm = result.calibration.unseen ? result.calibration.unseen->after_mm : 0.0;
  figures.accept_mm = error_figures(robot, data, poses_of(data, PoseSet::accept)).rms_mm;
  if (truths.empty()) return figures;
  const std::vector<ArmState> states = states_of(data, PoseSet::calibration);
  const auto among = [&](const std::vector<Effect>& found, const Effect& truth) {
    return std::ranges::any_of(found, [&](const Effect& one) { return is_truth(one, truth, data.robot, states); });
  };
  for (const Effect& truth : truths)
    if (!among(robot.effects, truth)) figures.missed.push_back(name_of(truth));
  for (const Effect& found : robot.effects) {
    const auto is_it = [&](const Effect& truth) { return is_truth(found, truth, data.robot, states); };
    if (std::ranges::none_of(truths, is_it)) figures.false_effects.push_back(name_of(found));
  }
  figures.true_causes_named = truths.size() - figures.missed.size();
  return figures;
}

EvolutionCase compared(std::string name, const DataSet& data, const DeclaredModel& declared, std::uint64_t seed,
                       const std::vector<Effect>& truths) {
  return {.name = std::move(name),
          .true_causes = truths.size(),
          .without = diagnosed(data, declared, seed, false, truths),
          .with = diagnosed(data, declared, seed, true, truths)};
}

/// Kinds in random order, each at most once, the one outside the catalogue last.
std::vector<std::string> drawn_kinds(bool outside, RandomStream& random) {
  std::vector<std::string> kinds;
  for (const KindRow& row : kind_table())
    if (row.in_pairs) kinds.push_back(row.kind);
  for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[random.index(i)]);
  if (outside) kinds.insert(kinds.begin(), kOutside);
  return kinds;
}

}  // namespace

double DiagnosisFigures::validation_with(std::size_t most) const {
  double least = HUGE_VAL;
  for (const FrontPoint& point : front)
    if (point.causes <= most) least = std::min(least, point.validation_rms_mm);
  return least;
}

EvolutionCase run_measured(const std::string& name, const DataSet& data, const DeclaredModel& declared,
                           std::uint64_t seed) {
  return compared(name, data, declared, seed, {});
}

std::optional<EvolutionCase> run_simulated(int number, const Robot& robot) {
  const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(number);
  const auto wanted = static_cast<std::size_t>(3 + number / 6 % 4);
  const bool outside = number % 2 == 1;
  const DeclaredModel& declared = row_of(kOutside).declared;
  Scenario scenario = varied_scene(seed, robot);
  const DataSet clean = measured(scenario);
  const Fit start = fit_declared(clean, poses_of(clean, PoseSet::calibration), declared, nominal_robot(clean));
  LoopOptions options;
  options.seed = seed;
  const LoopResult twin = close_loop(clean, declared, start, options);
  const DiagnosisProblem problem{clean, declared, poses_of(clean, PoseSet::calibration),
                                 poses_of(clean, PoseSet::validation)};
  const DetectionLimit limit(problem, twin.model);
  const auto just = [&](const NotFound& measure, const Effect& effect) { return limit.detectable(measure, effect); };
  RandomStream random{seed, kTruth};
  std::vector<Effect> truths;
  for (const std::string& kind : drawn_kinds(outside, random)) {
    if (truths.size() == wanted) break;
    if (auto truth =
            draw_truth(kind, twin.outcome.not_found, robot, states_of(clean, PoseSet::calibration), just, random))
      truths.push_back(std::move(*truth));
  }
  if (truths.size() < wanted) return std::nullopt;
  for (const Effect& truth : truths) inject(scenario, truth);
  EvolutionCase result =
      compared(robot.name + " " + std::to_string(number), measured(scenario), declared, seed, truths);
  result.outside = outside;
  return result;
}

}  // namespace demecal::bench
