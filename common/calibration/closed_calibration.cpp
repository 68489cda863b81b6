#include "calibration/closed_calibration.hpp"

#include "calibration/closing.hpp"
#include "calibration/formula_candidates.hpp"
#include "calibration/loop_passes.hpp"

namespace demecal {
namespace {

constexpr int kMostPasses = 3;

class Passes {
 public:
  Passes(const DataSet& data, const Job& job, const Preparation& preparation, const Calibration& first)
      : data_(data),
        job_(job),
        preparation_(preparation),
        first_(first),
        deciding_(deciding_poses(data)),
        closed_{first.robot, first, {}} {}

  ClosedCalibration run(const Evolve& evolve, const RoundWatcher& watch);

 private:
  bool look(const RoundWatcher& watch, std::vector<Candidate> formulas = {});
  std::vector<Candidate> evolve_formulas(const Evolve& evolve) const;
  bool evolve_anew(const Evolve& evolve);
  bool is_better(const CorrectedRobot& robot) const;
  bool may_look_again() const {
    const auto held = static_cast<int>(closed_.calibration.robot.effects.size());
    return pass_ < kMostPasses && held < job_.closed_loop.max_effects;
  }

  const DataSet& data_;
  const Job& job_;
  const Preparation& preparation_;
  const Calibration& first_;
  std::vector<std::size_t> deciding_;
  ClosedCalibration closed_;
  int pass_ = 1;
};

/// Whether the robot does better on the deciding poses than the model that is kept.
bool Passes::is_better(const CorrectedRobot& robot) const {
  return performance_index_mm2(robot, data_, deciding_) <
         performance_index_mm2(closed_.calibration.robot, data_, deciding_);
}

/// One pass of the loop; whether it added anything and another may follow.
bool Passes::look(const RoundWatcher& watch, std::vector<Candidate> formulas) {
  bool stopped = false;
  const auto watched = [&](const Round& round) {
    Round numbered = round;
    numbered.number += static_cast<int>(closed_.loop.rounds.size());
    stopped = watch && !watch(numbered);
    return !stopped;
  };
  const Fit& declared = preparation_.declared;
  const CorrectedRobot from = best_started(data_, job_.declared, declared, closed_.calibration.robot);
  const Fit start = loop_start(data_, declared, from);
  LoopOptions options = loop_options(job_);
  options.evolved = std::move(formulas);
  LoopResult found = close_loop(data_, job_.declared, start, options, watched);
  tidy(found.before);
  tidy(found.model);
  const bool first = pass_ == 1, added = added_any(found.outcome);
  if (first) closed_.before = found.before.robot;
  closed_.loop = first ? std::move(found.outcome) : joined(std::move(closed_.loop), std::move(found.outcome));
  if ((first && added) || is_better(found.model.robot)) {
    closed_.calibration = calibration_of(data_, job_.declared, preparation_, found.model);
  }
  return added && !stopped;
}

/// Whether the model with the corrections evolved anew is the better one, and kept.
bool Passes::evolve_anew(const Evolve& evolve) {
  const CorrectedRobot& present = closed_.calibration.robot;
  const Preparation again = prepare_again(data_, preparation_, present);
  if (again.training.empty()) return false;
  auto candidates = evolve(again.training);
  if (!candidates) return false;
  for (JointCandidates& joint : *candidates) {
    const std::size_t at = joint.training.joint;
    joint.others = {present.corrections[at], first_.robot.corrections[at]};
  }
  Calibration evolved = conclude(data_, job_, again, *candidates);
  count_from(first_, evolved);
  if (!is_better(evolved.robot)) return false;
  closed_.calibration = std::move(evolved);
  return true;
}

/// Formulas outside the catalogue that islands find in what the model leaves of each joint's error.
std::vector<Candidate> Passes::evolve_formulas(const Evolve& evolve) const {
  constexpr std::size_t kMostPerJoint = 12;
  const DiagnosisData of{data_, job_.declared, poses_of(data_, PoseSet::calibration),
                         poses_of(data_, PoseSet::validation)};
  const Fit start = loop_start(data_, preparation_.declared, closed_.calibration.robot);
  const std::vector<FormulaTable> tables = formula_tables(of, diagnosed_model(of, start));
  std::vector<JointTraining> training;
  for (const FormulaTable& table : tables) {
    training.push_back({.joint = static_cast<std::uint32_t>(table.joint),
                        .table = table.table,
                        .scale_rad = table.scale_rad,
                        .range_rad = {},
                        .branch = {}});
  }
  std::vector<Candidate> formulas;
  const auto fronts = evolve(training);
  for (std::size_t i = 0; fronts && i < fronts->size(); ++i) {
    for (Candidate& formula : formula_candidates(tables[i], (*fronts)[i].front, kMostPerJoint)) {
      formulas.push_back(std::move(formula));
    }
  }
  return formulas;
}

ClosedCalibration Passes::run(const Evolve& evolve, const RoundWatcher& watch) {
  while (look(watch) && job_.declared.joint_corrections && evolve_anew(evolve) && may_look_again()) ++pass_;
  const bool left = closed_.loop.p_structure_left <= job_.closed_loop.family_error;
  const bool asked = closed_.loop.stopped == StopReason::no_gain || closed_.loop.stopped == StopReason::no_structure;
  if (left && asked) {
    std::vector<Candidate> formulas = evolve_formulas(evolve);
    if (!formulas.empty()) {
      ++pass_;
      look(watch, std::move(formulas));
    }
  }
  tell_of(closed_.loop, closed_.calibration.robot, data_.robot);
  if (!added_any(closed_.loop)) closed_.before = closed_.calibration.robot;
  return std::move(closed_);
}

}  // namespace

ClosedCalibration close_calibration(const DataSet& data, const Job& job, const Preparation& preparation,
                                    const Calibration& first, const Evolve& evolve, const RoundWatcher& watch) {
  return Passes(data, job, preparation, first).run(evolve, watch);
}

}  // namespace demecal
