#include "calibration/closed_calibration.hpp"

#include "calibration/closing.hpp"
#include "calibration/distal_learning.hpp"
#include "calibration/formula_choice.hpp"
#include "calibration/formula_search.hpp"
#include "calibration/last_fit.hpp"
#include "calibration/loop_passes.hpp"
#include "diagnosis/candidates.hpp"
#include "random/random_purpose.hpp"

namespace demecal {
namespace {

constexpr int kMostPasses = 3;
constexpr int kSteps = 12;  ///< of Gauss and Newton

class Passes {
 public:
  Passes(const DataSet& data, const Job& job, const Preparation& preparation, const Calibration& first,
         Evolver& evolver, const KnownFunctions& known)
      : data_(data),
        job_(job),
        evolver_(evolver),
        known_(known),
        preparation_(preparation),
        first_(first),
        deciding_(deciding_poses(data)),
        closed_{first.robot, first, {}} {}

  ClosedCalibration run(const RoundWatcher& watch);

 private:
  void keep(DiagnosedModel model);
  bool look(const RoundWatcher& watch);
  Fit start_from(const CorrectedRobot& robot) const;
  LoopResult loop_from(const CorrectedRobot& robot, FormulaSearch evolved, const RoundWatcher& watch);
  void look_for_formulas(const RoundWatcher& watch);
  void settle(const DiagnosisProblem& of, DiagnosedModel& model) const;
  std::vector<Candidate> library() const;
  EvolvedJoints learn(const Preparation& preparation);
  bool evolve_anew();
  void fit_at_last();
  bool is_better(const CorrectedRobot& robot) const;
  bool may_look_again() const {
    const auto held = static_cast<int>(closed_.calibration.robot.effects.size());
    return pass_ < kMostPasses && held < job_.closed_loop.max_effects;
  }

  const DataSet& data_;
  const Job& job_;
  Evolver& evolver_;
  const KnownFunctions& known_;
  const Preparation& preparation_;
  const Calibration& first_;
  std::vector<std::size_t> deciding_;
  ClosedCalibration closed_;
  DiagnosedModel before_;               ///< that of closed_.before
  std::optional<DiagnosedModel> kept_;  ///< that of closed_.calibration, where it is the loop's
  int pass_ = 1;
  bool stopped_ = false;  ///< by the watcher
};

/// Whether the robot does better on the deciding poses than the model that is kept.
bool Passes::is_better(const CorrectedRobot& robot) const {
  return performance_index_mm2(robot, data_, deciding_) <
         performance_index_mm2(closed_.calibration.robot, data_, deciding_);
}

void Passes::keep(DiagnosedModel model) {
  closed_.calibration = calibration_of(data_, job_.declared, preparation_, model);
  kept_ = std::move(model);
}

Fit Passes::start_from(const CorrectedRobot& robot) const {
  const Fit& declared = preparation_.declared;
  return loop_start(data_, declared, best_started(data_, job_.declared, declared, robot));
}

/// One pass of the loop; `stopped_` is set where the watcher ends it.
LoopResult Passes::loop_from(const CorrectedRobot& robot, FormulaSearch evolved, const RoundWatcher& watch) {
  const auto watched = [&](const Round& round) {
    Round numbered = round;
    numbered.number += static_cast<int>(closed_.loop.rounds.size());
    stopped_ = watch && !watch(numbered);
    return !stopped_;
  };
  LoopOptions options = loop_options(job_);
  options.evolved = std::move(evolved.formulas);
  options.evolved_null_gains = std::move(evolved.luck_nats);
  LoopResult found = close_loop(data_, job_.declared, start_from(robot), options, watched);
  tidy(found.before);
  tidy(found.model);
  return found;
}

/// One pass from the model that is kept; whether it added anything and another may follow.
bool Passes::look(const RoundWatcher& watch) {
  LoopResult found = loop_from(closed_.calibration.robot, {}, watch);
  const bool first = pass_ == 1, added = added_any(found.outcome);
  if (first) {
    closed_.before = found.before.robot;
    before_ = found.before;
  }
  closed_.loop = first ? std::move(found.outcome) : joined(std::move(closed_.loop), std::move(found.outcome));
  if ((first && added) || is_better(found.model.robot)) keep(std::move(found.model));
  return added && !stopped_;
}

/// Candidates for the joint corrections, by the job's method.
EvolvedJoints Passes::learn(const Preparation& preparation) {
  evolver_.announce(Purpose::corrections);
  if (job_.method != Method::distal) {
    return evolver_.evolve(preparation.training, {.seed = job_.seed,
                                                  .generations = job_.gp.number_generations,
                                                  .functions = known_.value_or(std::vector<SharedFunction>{})});
  }
  DistalOutcome outcome = learn_distally(data_, job_, preparation, evolver_, known_);
  return {std::move(outcome.candidates), outcome.is_complete};
}

/// Whether the model with the corrections evolved anew is the better one, and kept.
bool Passes::evolve_anew() {
  const CorrectedRobot& present = closed_.calibration.robot;
  const Preparation again = prepare_again(data_, preparation_, present);
  if (again.training.empty()) return false;
  EvolvedJoints candidates = learn(again);
  if (!candidates.is_complete) return false;
  for (JointCandidates& joint : candidates.joints) {
    const std::size_t at = joint.training.joint;
    joint.others.push_back(present.corrections[at]);
    joint.others.push_back(first_.robot.corrections[at]);
  }
  Calibration evolved = conclude(data_, job_, again, candidates.joints);
  count_from(first_, evolved);
  if (!is_better(evolved.robot)) return false;
  closed_.calibration = std::move(evolved);
  kept_.reset();
  return true;
}

/// All choices made, the numbers are fitted to the validation poses as well where accept poses can tell the error.
void Passes::fit_at_last() {
  const DeclaredModel& declared = job_.declared;
  LoopEnds ends;
  ends.after =
      kept_ ? *kept_ : with_corrections_kept(data_, declared, preparation_.declared, closed_.calibration.robot);
  ends.before = added_any(closed_.loop) ? before_ : ends.after;
  std::optional<LastFit> last = last_fit(data_, declared, std::move(ends));
  if (!last) return;
  closed_.calibration = calibration_of(data_, declared, preparation_, last->ends.after);
  closed_.calibration.unseen = last->unseen;
  closed_.before = std::move(last->ends.before.robot);
  tell_of(closed_.loop, closed_.calibration.robot, data_.robot);
}

/// What competes in every pass, at its price.
std::vector<Candidate> Passes::library() const {
  Evidence evidence = evidence_of(data_, poses_of(data_, PoseSet::calibration));
  evidence.highest_ratio = job_.closed_loop.highest_ratio;
  evidence.stated_ratios = job_.closed_loop.ratios;
  return candidates_for(data_.robot, evidence, job_.declared,
                        {.kinds = job_.closed_loop.candidates, .formulas = true, .decoys = false});
}

/// Corrections that were fitted around a residual which a formula explains since may do better begun anew.
void Passes::settle(const DiagnosisProblem& of, DiagnosedModel& model) const {
  DiagnosedModel again = refined(of, diagnosed_model(of, start_from(model.robot)), kSteps);
  tidy(again);
  const double present_mm2 = performance_index_mm2(model.robot, data_, deciding_);
  if (performance_index_mm2(again.robot, data_, deciding_) < present_mm2) model = std::move(again);
}

/// Islands seek formulas in what the model leaves without those of the library; one more pass, in which both compete,
/// begins there. Its model is kept where it is the better description.
void Passes::look_for_formulas(const RoundWatcher& watch) {
  const DiagnosisProblem of{data_, job_.declared, poses_of(data_, PoseSet::calibration),
                         poses_of(data_, PoseSet::validation)};
  const CorrectedRobot bare = without_formulas(closed_.calibration.robot);
  const DiagnosedModel model = refined(of, diagnosed_model(of, start_from(bare)), kSteps);
  FormulaSearch search =
      search_formulas(of, model, evolver_, {job_.seed, job_.gp.number_generations}, job_.closed_loop.family_error,
                      RandomStream{job_.seed, number_of(RandomPurpose::formula_null)});
  if (search.formulas.empty()) return;
  std::vector<Candidate> candidates = library();
  candidates.insert(candidates.end(), search.formulas.begin(), search.formulas.end());
  ++pass_;
  LoopResult found = loop_from(bare, std::move(search), watch);
  settle(of, found.model);
  if (!describes_better(found.model.robot, closed_.calibration.robot, data_, candidates)) {
    note_unkept(found.outcome, closed_.calibration.robot, closed_.loop);
    return;
  }
  closed_.loop = joined(std::move(closed_.loop), std::move(found.outcome));
  keep(std::move(found.model));
}

ClosedCalibration Passes::run(const RoundWatcher& watch) {
  while (look(watch) && job_.declared.joint_corrections && evolve_anew() && may_look_again()) ++pass_;
  const bool asked = asks_for_formulas(closed_.loop, closed_.calibration.robot, job_.closed_loop);
  if (asked && !stopped_) look_for_formulas(watch);
  tell_of(closed_.loop, closed_.calibration.robot, data_.robot);
  if (!added_any(closed_.loop)) closed_.before = closed_.calibration.robot;
  fit_at_last();
  return std::move(closed_);
}

}  // namespace

ClosedCalibration close_calibration(const DataSet& data, const Job& job, const Preparation& preparation,
                                    const Calibration& first, Evolver& evolver, const RoundWatcher& watch,
                                    const KnownFunctions& known) {
  return Passes(data, job, preparation, first, evolver, known).run(watch);
}

}  // namespace demecal
