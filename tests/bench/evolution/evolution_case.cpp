#include "evolution_case.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "calibration/training.hpp"
#include "closed_loop/case_plan.hpp"
#include "closed_loop/draw_truth.hpp"
#include "closed_loop/scene.hpp"
#include "closed_loop/score.hpp"
#include "closed_loop/truth.hpp"
#include "diagnosis/loop.hpp"
#include "explanations/causes.hpp"
#include "explanations/explanation_front.hpp"
#include "expression/evaluate.hpp"
#include "fitting/fit.hpp"
#include "prediction/measurement.hpp"
#include "report/make_report.hpp"
#include "residuals/diagnosed_model.hpp"
#include "simulation/scenario.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

constexpr std::uint64_t kFirstSeed = 20261200;
constexpr std::uint64_t kTruth = 22;  ///< of an arm's random streams

/// What a diagnosis calls the truths of an arm.
class Naming {
 public:
  /// Keeps all by reference.
  Naming(const CorrectedRobot& found, const LoopOutcome& loop, const Robot& robot, const std::vector<ArmState>& states)
      : found_(found), loop_(loop), robot_(robot), states_(states) {}

  bool names(const Effect& truth) const {
    return std::ranges::any_of(found_.effects, [&](const Effect& found) { return is_it(found, truth); });
  }
  bool is_of(const Effect& found, const std::vector<Effect>& truths) const {
    return std::ranges::any_of(truths, [&](const Effect& truth) { return is_it(found, truth); });
  }
  /// Whether every effect is a truth or stands in the place of one that is not named and that these poses do not tell
  /// from it, and every truth is one of these.
  bool is_exact_but_for_class(const std::vector<Effect>& truths) const {
    std::vector<bool> told;
    for (const Effect& truth : truths) told.push_back(names(truth));
    for (const Effect& found : found_.effects) {
      if (is_of(found, truths)) continue;
      std::size_t i = 0;
      while (i < truths.size() && (told[i] || !is_one_with(found, truths[i]))) ++i;
      if (i == truths.size()) return false;
      told[i] = true;
    }
    return std::ranges::count(told, false) == 0;
  }

 private:
  /// Formulas of a joint count together, however many a law is written as.
  bool is_it(const Effect& found, const Effect& truth) const {
    if (is_truth(found, truth, robot_, states_)) return true;
    if (!is_symbolic(found) || !is_symbolic(truth) || found.joint != truth.joint) return false;
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(std::ssize(states_));
    for (const Effect& other : found_.effects)
      if (is_symbolic(other) && other.joint == truth.joint) motion += joint_motion(other, robot_, states_);
    return go_together(motion, joint_motion(truth, robot_, states_));
  }

  bool is_one_with(const Effect& found, const Effect& truth) const {
    constexpr double kAsOne = 0.98;
    return std::ranges::any_of(loop_.rounds, [&](const Round& round) {
      return round.effect.same_law_as(found) && std::ranges::any_of(round.rivals, [&](const Rival& rival) {
               return rival.cosine > kAsOne && is_truth(rival.effect, truth, robot_, states_);
             });
    });
  }

  const CorrectedRobot& found_;
  const LoopOutcome& loop_;
  const Robot& robot_;
  const std::vector<ArmState>& states_;
};

/// The largest value of every term of a sum over an interval, by a grid.
std::vector<double> sizes_of_terms(std::span<const Node> sum, const Interval& range_rad) {
  if (sum.front().primitive == Primitive::add || sum.front().primitive == Primitive::subtract) {
    const std::size_t second = subtree_end(sum, 1);
    std::vector<double> sizes = sizes_of_terms(sum.subspan(1, second - 1), range_rad);
    std::ranges::copy(sizes_of_terms(sum.subspan(second), range_rad), std::back_inserter(sizes));
    return sizes;
  }
  constexpr int kGrid = 512;
  double largest = 0.0;
  for (int i = 0; i <= kGrid; ++i) {
    const double theta = std::lerp(range_rad.lower, range_rad.upper, static_cast<double>(i) / kGrid);
    largest = std::max(largest, std::abs(evaluate(sum, std::span(&theta, 1))));
  }
  return {largest};
}

CorrectionFigures correction_figures(const DataSet& data, const Job& job, const CalibrateResult& result) {
  CorrectionFigures figures;
  CorrectedRobot shortened = result.model.robot;
  if (!has_corrections(shortened)) return figures;
  const std::vector<std::optional<ShortForm>> forms = short_forms(data, shortened);
  for (std::size_t joint = 0; joint < shortened.corrections.size(); ++joint) {
    JointCorrection& correction = shortened.corrections[joint];
    if (correction.is_neutral()) continue;
    ++figures.joints;
    figures.most_nodes = std::max(figures.most_nodes, correction.formula().size());
    figures.least_term_rad = std::min(figures.least_term_rad,
                                      std::ranges::min(sizes_of_terms(correction.formula(), correction.range_rad())));
    if (!forms[joint]) continue;
    ++figures.shortened;
    correction = forms[joint]->correction;
  }
  const auto accept = poses_of(data, PoseSet::accept);
  figures.accept_with_short_forms =
      error_figures(shortened, data, accept).rms_mm / error_figures(result.model.robot, data, accept).rms_mm;
  const JointTargets targets = targets_about(data, prepare(data, job), result.model.robot);
  for (const JointTraining& training : training_tables(result.model.robot.chain, targets)) {
    const JointSummary& joint = result.calibration.joints[training.joint];
    if (joint.kept)
      figures.most_bound_over_limit =
          std::max(figures.most_bound_over_limit, joint.bound_rad / correction_limit_rad(training));
  }
  return figures;
}

/// The model of these effects and all that is declared, fitted to the calibration poses.
DiagnosedModel model_of(const DiagnosisProblem& problem, const Fit& start, std::vector<Effect> effects) {
  constexpr int kSteps = 12;
  CorrectedRobot robot = start.robot;
  robot.effects = std::move(effects);
  return refined(problem, diagnosed_model(problem, loop_start(problem.data, start, robot)), kSteps);
}

DiagnosisProblem problem_of(const DataSet& data, const DeclaredModel& declared) {
  return {data, declared, poses_of(data, PoseSet::calibration), poses_of(data, PoseSet::validation)};
}

double rms_of_judging_mm(const DiagnosisProblem& problem, const CorrectedRobot& robot) {
  return std::sqrt(mean(squared_errors(problem.data, judging_poses(problem, robot), robot)));
}

/// See EvolutionFigures::validation_of_first_mm; `kept` are the effects of the model that the rounds made.
std::vector<double> validation_of_first(const DiagnosisProblem& problem, const std::vector<Round>& rounds,
                                        const std::vector<Effect>& kept) {
  const Fit start = fit_declared(problem.data, problem.fitted, problem.declared, nominal_robot(problem.data));
  std::vector<double> rms_mm{rms_of_judging_mm(problem, model_of(problem, start, {}).robot)};
  CorrectedRobot next;
  const auto add_error = [&] {
    const double last_mm = rms_mm.back();
    rms_mm.resize(causes_of(next).size() + 1, last_mm);
    rms_mm.back() = rms_of_judging_mm(problem, model_of(problem, start, next.effects).robot);
  };
  for (const Round& round : rounds) {
    if (round.verdict != Verdict::added) continue;
    if (std::ranges::none_of(kept, [&](const Effect& one) { return one.same_law_as(round.effect); })) continue;
    const std::size_t before = causes_of(next).size();
    CorrectedRobot longer = next;
    longer.effects.push_back(round.effect);
    if (before > 0 && causes_of(longer).size() > before) add_error();
    next = std::move(longer);
  }
  if (!next.effects.empty()) add_error();
  return rms_mm;
}

EvolutionFigures diagnosed(const DataSet& data, const DeclaredModel& declared, std::uint64_t seed, bool evolve,
                           const std::vector<Effect>& truths) {
  Job job;
  job.name = data.name;
  job.method = Method::diagnose;
  job.declared = declared;
  job.seed = seed;
  if (!evolve) job.explanations.variations = 0;
  const auto begin = std::chrono::steady_clock::now();
  const CalibrateResult result = diagnose(data, job, std::nullopt, {}).result;
  EvolutionFigures figures;
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.front = result.calibration.budget.front;
  figures.causes = result.calibration.budget.causes.size();
  const CorrectedRobot& robot = result.model.robot;
  figures.effects = robot.effects.size();
  figures.validation_mm = result.calibration.unseen ? result.calibration.unseen->after_mm : 0.0;
  figures.accept_mm = error_figures(robot, data, poses_of(data, PoseSet::accept)).rms_mm;
  figures.fitted_mm = error_figures(robot, data, poses_of_last_fit(data)).rms_mm;
  figures.corrections = correction_figures(data, job, result);
  if (!evolve)
    figures.validation_of_first_mm = validation_of_first(problem_of(data, declared), result.loop.rounds, robot.effects);
  if (truths.empty()) return figures;
  const std::vector<ArmState> states = states_of(data, PoseSet::calibration);
  const Naming naming(robot, result.loop, data.robot, states);
  for (const Effect& truth : truths)
    if (!naming.names(truth)) figures.missed.push_back(words(truth, data.robot));
  for (const Effect& found : robot.effects)
    if (!naming.is_of(found, truths)) figures.false_effects.push_back(words(found, data.robot));
  figures.outside_named = naming.names(truths.front());
  figures.true_causes_named = truths.size() - figures.missed.size();
  figures.is_exact_but_for_class = naming.is_exact_but_for_class(truths);
  return figures;
}

EvolutionCase compared(std::string name, const DataSet& data, const DeclaredModel& declared, std::uint64_t seed,
                       const std::vector<Effect>& truths) {
  EvolutionCase result{.name = std::move(name),
                       .seed = seed,
                       .true_causes = truths.size(),
                       .without = diagnosed(data, declared, seed, false, truths),
                       .with = diagnosed(data, declared, seed, true, truths)};
  if (truths.empty()) return result;
  const DiagnosisProblem problem{data, declared, poses_of_last_fit(data), {}};
  const Fit start = fit_declared(data, problem.fitted, declared, nominal_robot(data));
  const CorrectedRobot truth = model_of(problem, start, truths).robot;
  result.fitted_of_truth_mm = error_figures(truth, data, problem.fitted).rms_mm;
  result.accept_of_truth_mm = error_figures(truth, data, poses_of(data, PoseSet::accept)).rms_mm;
  return result;
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

double EvolutionFigures::validation_with(std::size_t most) const {
  double least = HUGE_VAL;
  for (const FrontPoint& point : front)
    if (point.causes <= most) least = std::min(least, point.validation_rms_mm);
  return least;
}

double EvolutionFigures::validation_with_first(std::size_t most) const {
  return std::ranges::min(std::span(validation_of_first_mm).first(std::min(most + 1, validation_of_first_mm.size())));
}

EvolutionCase run_measured(const std::string& name, const DataSet& data, const DeclaredModel& declared,
                           std::uint64_t seed) {
  return compared(name, data, declared, seed, {});
}

Mixture varied_mixture(int number) {
  return {.causes = static_cast<std::size_t>(3 + number / 6 % 4), .outside = number % 2 == 1};
}

std::optional<EvolutionCase> run_simulated(int number, const Mixture& mixture, const Robot& robot) {
  const std::uint64_t seed = kFirstSeed + static_cast<std::uint64_t>(number);
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
  for (const std::string& kind : drawn_kinds(mixture.outside, random)) {
    if (truths.size() == mixture.causes) break;
    if (auto truth =
            draw_truth(kind, twin.outcome.not_found, robot, states_of(clean, PoseSet::calibration), just, random))
      truths.push_back(std::move(*truth));
  }
  if (truths.size() < mixture.causes) return std::nullopt;
  for (const Effect& truth : truths) inject(scenario, truth);
  EvolutionCase result =
      compared(robot.name + " " + std::to_string(number), measured(scenario), declared, seed, truths);
  result.outside = is_symbolic(truths.front());
  return result;
}

}  // namespace demecal::bench
