#include "closed_calibration/closed_calibration.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "closed_calibration/closing.hpp"
#include "closed_calibration/loop_passes.hpp"
#include "closed_calibration/one_place.hpp"
#include "diagnosis/candidates.hpp"
#include "distal/learning.hpp"
#include "distal/steps.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "effects/effect.hpp"
#include "explanations/error_budget.hpp"
#include "explanations/explanation_search.hpp"
#include "expression/shared_function.hpp"
#include "fitness/parameters.hpp"
#include "fitting/fit.hpp"
#include "formula_search/formula_search.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline closed_calibration {
namespace {

constexpr int kMostPasses = 3;
constexpr int kRefinementSteps = 12;  ///< of Gauss and Newton

class LoopPasses {
 public:
  LoopPasses(const DataSet& data, const Job& job, const Preparation& preparation, const Calibration& first,
             Evolver& evolver, const KnownFunctions& functions)
      : data_(data),
        job_(job),
        evolver_(evolver),
        functions_(functions),
        preparation_(preparation),
        first_(first),
        selection_poses_(selection_poses(data, preparation.declared.robot)),
        closed_{.before = first.robot, .calibration = first, .loop = {}} {}

  ClosedCalibration run(const RoundWatcher& watch);

 private:
  void adopt(LoopResult found, const std::vector<JointSummary>& start);
  bool run_pass(const RoundWatcher& watch);
  CorrectedRobot start_from(const CorrectedRobot& robot) const {
    return better_start(data_, job_.declared, preparation_.declared, robot);
  }
  Fit fit_beside(const CorrectedRobot& start) const { return loop_start(data_, preparation_.declared, start); }
  DiagnosedModel refined_from(const DiagnosisProblem& problem, const CorrectedRobot& start) const {
    return refined(problem, diagnosed_model(problem, fit_beside(start)), kRefinementSteps);
  }
  LoopResult run_loop(const CorrectedRobot& start, FormulaSearch evolved, const RoundWatcher& watch);
  LoopResult run_first_loop(const RoundWatcher& watch);
  void run_formula_pass(const RoundWatcher& watch);
  void restart_if_better(const DiagnosisProblem& problem, DiagnosedModel& model) const;
  std::vector<Candidate> catalogue_candidates() const;
  EvolvedJoints learn(const Preparation& preparation);
  bool evolve_corrections_again();
  void refit_with_validation();
  bool is_better(const CorrectedRobot& robot, const CorrectedRobot& than) const {
    return performance_index_mm2(robot, data_, selection_poses_) < performance_index_mm2(than, data_, selection_poses_);
  }
  /// Whether the robot does better on the selection poses than the model that is kept.
  bool is_better(const CorrectedRobot& robot) const { return is_better(robot, closed_.calibration.robot); }
  bool allows_another_pass() const {
    const auto held = static_cast<int>(closed_.calibration.robot.effects.size());
    return pass_ < kMostPasses && held < job_.closed_loop.max_effects;
  }

  const DataSet& data_;
  const Job& job_;
  Evolver& evolver_;
  const KnownFunctions& functions_;
  const Preparation& preparation_;
  const Calibration& first_;
  std::vector<std::size_t> selection_poses_;
  ClosedCalibration closed_;
  DiagnosedModel before_;                  ///< that of closed_.before
  std::optional<DiagnosedModel> adopted_;  ///< that of closed_.calibration, where it is the loop's
  ExplanationFront front_;                 ///< about that
  std::optional<DiagnosedModel> best_;     ///< of its points, where it is another
  int pass_ = 1;
  int rounds_told_ = 0;
  bool stopped_ = false;  ///< by the watcher
};

/// `start`: of the corrections that it began with.
void LoopPasses::adopt(LoopResult found, const std::vector<JointSummary>& start) {
  Calibration calibration = calibration_of(data_, job_.declared, preparation_, found.model);
  set_origins(found.model, start, calibration);
  closed_.calibration = std::move(calibration);
  adopted_ = std::move(found.model);
  front_ = std::move(found.front);
  best_ = std::move(found.best);
}

/// One run of the loop; `stopped_` is set where the watcher ends it.
LoopResult LoopPasses::run_loop(const CorrectedRobot& start, FormulaSearch evolved, const RoundWatcher& watch) {
  const auto watched = [&](const Round& round) {
    Round numbered = round;
    numbered.number += rounds_told_;
    stopped_ = watch && !watch(numbered);
    return !stopped_;
  };
  LoopOptions options = loop_options(job_);
  options.evolved = std::move(evolved.formulas);
  options.evolved_null_gains = std::move(evolved.null_nats);
  options.work = work_of(evolver_);
  LoopResult found = close_loop(data_, job_.declared, fit_beside(start), options, watched);
  rounds_told_ += static_cast<int>(found.outcome.rounds.size());
  take_back_unjudged(data_, found);
  stopped_ = stopped_ || evolver_.is_interrupted();
  drop_negligible_terms(found.before);
  drop_negligible_terms(found.model);
  return found;
}

/// Corrections that were evolved before effects are known may take in a part of what these would explain: the loop that
/// begins without any is a candidate too.
LoopResult LoopPasses::run_first_loop(const RoundWatcher& watch) {
  const CorrectedRobot start = start_from(closed_.calibration.robot);
  LoopResult found = run_loop(start, {}, watch);
  if (stopped_ || !job_.declared.joint_corrections || !has_corrections(start)) return found;
  evolver_.announce_loop_without_corrections();
  LoopResult bare = run_loop(without_corrections(start), {}, watch);
  if (is_better(bare.model.robot, found.model.robot)) found = std::move(bare);
  return found;
}

/// One pass from the model that is kept; whether it added anything and another may follow.
bool LoopPasses::run_pass(const RoundWatcher& watch) {
  const bool first = pass_ == 1;
  LoopResult found = first ? run_first_loop(watch) : run_loop(start_from(closed_.calibration.robot), {}, watch);
  const bool added = added_any(found.outcome);
  if (first) {
    closed_.before = found.before.robot;
    before_ = found.before;
  }
  closed_.loop = first ? std::move(found.outcome) : joined(std::move(closed_.loop), std::move(found.outcome));
  if ((first && added) || is_better(found.model.robot)) adopt(std::move(found), closed_.calibration.joints);
  return added && !stopped_;
}

/// Candidates for the joint corrections, by the job's method.
EvolvedJoints LoopPasses::learn(const Preparation& preparation) {
  evolver_.announce(Purpose::corrections);
  if (job_.method != Method::distal) {
    return evolver_.evolve(preparation.training, {.seed = job_.seed,
                                                  .generations = job_.gp.number_generations,
                                                  .functions = functions_.value_or(std::vector<SharedFunction>{})});
  }
  DistalOutcome outcome = learn_distally(data_, job_, preparation, evolver_, functions_);
  return {std::move(outcome.candidates), outcome.is_complete};
}

/// Whether the model with the corrections evolved anew is the better one, and kept.
bool LoopPasses::evolve_corrections_again() {
  const CorrectedRobot& present = closed_.calibration.robot;
  const Preparation again = prepare_beside_effects(data_, preparation_, present);
  if (again.training.empty()) return false;
  EvolvedJoints candidates = learn(again);
  if (!candidates.is_complete) return false;
  for (JointCandidates& joint : candidates.joints) {
    const std::size_t at = joint.training.joint;
    joint.alternatives.push_back(present.corrections[at]);
    joint.alternatives.push_back(first_.robot.corrections[at]);
  }
  Calibration evolved = conclude(data_, job_, again, candidates.joints);
  keep_first_figures(first_, evolved);
  for (std::size_t joint = 0; joint < evolved.joints.size(); ++joint) {
    const JointCorrection& chosen = evolved.robot.corrections[joint];
    if (!chosen.is_neutral() && chosen.formula() == shortened(present.corrections[joint]).formula())
      evolved.joints[joint].origin = closed_.calibration.joints[joint].origin;
  }
  if (!is_better(evolved.robot)) return false;
  closed_.calibration = std::move(evolved);
  adopted_.reset();
  return true;
}

/// All choices made, the numbers are fitted to the validation poses as well where accept poses can tell the error.
void LoopPasses::refit_with_validation() {
  const DeclaredModel& declared = job_.declared;
  LoopModels ends;
  ends.after = adopted_ ? with_bounded_corrections(data_, declared, preparation_, poses_of(data_, PoseSet::calibration),
                                                   *adopted_)
                        : with_fixed_corrections(data_, declared, preparation_.declared, closed_.calibration.robot);
  ends.before = added_any(closed_.loop) ? before_ : ends.after;
  std::optional<LastFit> last = last_fit(data_, declared, preparation_, ends);
  const DiagnosisProblem problem{data_, declared, poses_of(data_, PoseSet::calibration),
                                 poses_of(data_, PoseSet::validation)};
  const ExplanationFront front = adopted_ ? front_ : pruned_front(problem, ends.after);
  ErrorBudget budget =
      error_budget_of(data_, declared, ends.after, front, last ? last->ends.after : ends.after, job_.seed);
  if (adopted_) closed_.best = calibration_of_best(data_, declared, preparation_, ends.before.robot, std::move(best_));
  if (last) {
    const std::vector<JointSummary> start = std::move(closed_.calibration.joints);
    closed_.calibration = calibration_of(data_, declared, preparation_, last->ends.after);
    set_origins(last->ends.after, start, closed_.calibration);
    closed_.calibration.unseen = last->unseen;
  }
  closed_.calibration.budget = std::move(budget);
  if (!last) return;
  closed_.before = std::move(last->ends.before.robot);
  update_rounds(closed_.loop, closed_.calibration.robot, data_.robot);
}

/// What competes in every pass, at its price.
std::vector<Candidate> LoopPasses::catalogue_candidates() const {
  Evidence evidence = evidence_of(data_, poses_of(data_, PoseSet::calibration));
  evidence.highest_ratio = job_.closed_loop.highest_ratio;
  evidence.stated_ratios = job_.closed_loop.ratios;
  return candidates_for(data_.robot, evidence, job_.declared,
                        {.kinds = job_.closed_loop.candidates, .formulas = true, .decoys = false});
}

/// Corrections that were fitted around a residual which a formula explains since may do better begun anew.
void LoopPasses::restart_if_better(const DiagnosisProblem& problem, DiagnosedModel& model) const {
  DiagnosedModel again = refined_from(problem, start_from(model.robot));
  drop_negligible_terms(again);
  if (is_better(again.robot, model.robot)) model = std::move(again);
}

/// Islands seek formulas in what the model leaves without those of the library; one more pass, in which both compete,
/// begins there. Its model is kept where it is the better description.
void LoopPasses::run_formula_pass(const RoundWatcher& watch) {
  const DiagnosisProblem problem{data_, job_.declared, poses_of(data_, PoseSet::calibration),
                                 poses_of(data_, PoseSet::validation)};
  const CorrectedRobot bare = without_formulas(closed_.calibration.robot);
  const CorrectedRobot start = start_from(bare);
  const DiagnosedModel model = refined_from(problem, start);
  FormulaSearch search =
      search_formulas(problem, model, evolver_, {job_.seed, job_.gp.number_generations}, job_.closed_loop.family_error,
                      RandomStream{job_.seed, number_of(RandomPurpose::formula_null)});
  if (search.formulas.empty()) return;
  std::vector<Candidate> candidates = catalogue_candidates();
  candidates.insert(candidates.end(), search.formulas.begin(), search.formulas.end());
  ++pass_;
  LoopResult found = run_loop(start, std::move(search), watch);
  Calibration begun = closed_.calibration;
  set_origins(found.model, closed_.calibration.joints, begun);
  restart_if_better(problem, found.model);
  if (!describes_better(found.model.robot, closed_.calibration.robot, data_, candidates)) {
    append_rejected_rounds(found.outcome, closed_.calibration.robot, closed_.loop);
    return;
  }
  closed_.loop = joined(std::move(closed_.loop), std::move(found.outcome));
  adopt(std::move(found), begun.joints);
}

ClosedCalibration LoopPasses::run(const RoundWatcher& watch) {
  while (run_pass(watch) && job_.declared.joint_corrections && evolve_corrections_again() && allows_another_pass())
    ++pass_;
  const bool asked = needs_formula_search(closed_.loop, closed_.calibration.robot, job_.closed_loop);
  if (asked && !stopped_) run_formula_pass(watch);
  update_rounds(closed_.loop, closed_.calibration.robot, data_.robot);
  if (!added_any(closed_.loop)) closed_.before = closed_.calibration.robot;
  refit_with_validation();
  return std::move(closed_);
}

}  // namespace

ClosedCalibration close_calibration(const DataSet& data, const Job& job, const Preparation& preparation,
                                    const Calibration& first, Evolver& evolver, const RoundWatcher& watch,
                                    const KnownFunctions& functions) {
  return LoopPasses(data, job, preparation, first, evolver, functions).run(watch);
}

}  // namespace demecal::inline closed_calibration
