#include "calibration/selection.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "calibration/admissible.hpp"
#include "calibration/training.hpp"
#include "effects/arm_state.hpp"
#include "evolution/model_archive.hpp"
#include "expression/bound.hpp"
#include "fitness/fitness.hpp"
#include "kinematics/units.hpp"
#include "pieces/pieces.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline calibration {
namespace {

constexpr int kSweeps = 5;
constexpr double kSignificant = 2.0;  ///< standard errors of the gain: about one false keep in forty

struct CorrectionTrial {
  JointCorrection correction;
  SquaredErrors errors;
  double sum = 0.0;
};

std::vector<CorrectionTrial> evaluate_all(const PoseEvaluator& selecting, const CorrectedRobot& robot,
                                          const std::vector<JointVector>& neutral, std::size_t joint,
                                          const std::vector<JointCorrection>& admissible) {
  std::vector<CorrectionTrial> trials(admissible.size());
  in_pieces(trials.size(), [&](std::size_t i) {
    CorrectionTrial& trial = trials[i];
    trial.correction = admissible[i];
    trial.errors = selecting.squared_errors(robot, selecting.with(neutral, joint, trial.correction));
    trial.sum = sum(trial.errors);
  });
  std::erase_if(trials, [](const CorrectionTrial& trial) { return !std::isfinite(trial.sum); });
  return trials;
}

/// The trial of the briefest description; of equals the first. Null where there is none.
const CorrectionTrial* shortest_description(const std::vector<CorrectionTrial>& trials, double rows) {
  const auto nats = [rows](const CorrectionTrial& trial) {
    return description_length_nats(trial.correction.formula(), std::max(trial.sum, 1e-300), rows);
  };
  const auto best = std::ranges::min_element(trials, {}, nats);
  return best == trials.end() ? nullptr : &*best;
}

/// The shortest trial not significantly worse than the best; null where there is none.
const CorrectionTrial* shortest_near_best(const std::vector<CorrectionTrial>& trials) {
  const auto best = std::ranges::min_element(trials, {}, &CorrectionTrial::sum);
  const CorrectionTrial* chosen = nullptr;
  const auto length = [](const CorrectionTrial& trial) { return trial.correction.formula().size(); };
  for (const CorrectionTrial& trial : trials) {
    const PairedDifference behind = paired(trial.errors, best->errors);
    const bool close = &trial == &*best || behind.mean <= 0.5 * behind.standard_error;
    if (close && (chosen == nullptr || length(trial) < length(*chosen))) chosen = &trial;
  }
  return chosen;
}

/// Poses by what they are asked.
struct PoseEvaluators {
  PoseEvaluator selecting;
  PoseEvaluator fitted;
};

/// Whether a gain exceeds what its standard error explains.
bool is_significant(const PairedDifference& gain) {
  return gain.mean > kSignificant * gain.standard_error;
}

/// The fall of the error from joints at which one is neutral to those with its correction.
PairedDifference gain_of(const PoseEvaluator& evaluator, const CorrectedRobot& robot,
                         const std::vector<JointVector>& neutral, std::size_t joint,
                         const JointCorrection& correction) {
  return paired(evaluator.squared_errors(robot, neutral),
                evaluator.squared_errors(robot, evaluator.with(neutral, joint, correction)));
}

/// The correction this joint is best given while the others stand as they do in `robot`.
JointCorrection choose(const PoseEvaluators& evaluators, CorrectedRobot robot, const JointTraining& training,
                       const std::vector<JointCorrection>& admissible, JointChoice& choice) {
  const std::size_t joint = training.joint;
  robot.corrections[joint] = JointCorrection{};
  const std::vector<JointVector> neutral = evaluators.selecting.corrected(robot);
  const std::vector<CorrectionTrial> trials = evaluate_all(evaluators.selecting, robot, neutral, joint, admissible);
  // Formulas of distal learning depend on the other joints': each alone leaves too much error to outweigh its length.
  const bool is_distal = training.table.loss == Loss::squared;
  const CorrectionTrial* chosen =
      is_distal ? shortest_near_best(trials) : shortest_description(trials, evaluators.selecting.rows());
  choice.kept = false;
  if (chosen == nullptr) return {};
  const PairedDifference gain = paired(evaluators.selecting.squared_errors(robot, neutral), chosen->errors);
  choice.kept =
      is_significant(gain) &&
      is_significant(gain_of(evaluators.fitted, robot, evaluators.fitted.corrected(robot), joint, chosen->correction));
  choice.gain_mm2 = gain.mean;
  choice.gain_error_mm2 = gain.standard_error;
  return choice.kept ? chosen->correction : JointCorrection{};
}

bool same_correction(const JointCorrection& a, const JointCorrection& b) {
  return a.is_neutral() == b.is_neutral() && a.formula() == b.formula();
}

/// Sweeps over the joints from the corrections in `selection.robot` until nothing changes.
Selection sweep(const PoseEvaluators& evaluators, Selection selection, std::span<const JointCandidates> candidates,
                const std::vector<std::vector<JointCorrection>>& admissible) {
  bool changed = true;
  for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      JointCorrection& present = selection.robot.corrections[candidates[i].training.joint];
      const JointCorrection next =
          choose(evaluators, selection.robot, candidates[i].training, admissible[i], selection.choices[i]);
      changed = changed || !same_correction(present, next);
      present = next;
    }
  }
  return selection;
}

/// Every joint with what fits its own targets best: the targets belong together, one joint's with another's.
CorrectedRobot with_fittest(CorrectedRobot robot, std::span<const JointCandidates> candidates) {
  for (const JointCandidates& joint : candidates) {
    robot.corrections[joint.training.joint] = fittest_correction(joint);
  }
  return robot;
}

/// Every joint with its candidate from elsewhere at place `set`, where it has one.
CorrectedRobot with_alternatives(CorrectedRobot robot, std::span<const JointCandidates> candidates, std::size_t set) {
  for (const JointCandidates& joint : candidates) {
    if (set >= joint.alternatives.size() || !is_bounded(joint.alternatives[set], joint.training)) continue;
    robot.corrections[joint.training.joint] = joint.alternatives[set];
  }
  return robot;
}

struct StartingPoint {
  CorrectedRobot robot;
  std::optional<std::size_t> set{};  ///< of corrections from elsewhere, where it is made of one
};

std::vector<StartingPoint> starting_points(const CorrectedRobot& declared,
                                           std::span<const JointCandidates> candidates) {
  std::vector<StartingPoint> starts{{declared}, {with_fittest(declared, candidates)}};
  std::size_t sets = 0;
  for (const JointCandidates& joint : candidates) sets = std::max(sets, joint.alternatives.size());
  for (std::size_t set = 0; set < sets; ++set) starts.push_back({with_alternatives(declared, candidates, set), set});
  return starts;
}

}  // namespace

double sum(const SquaredErrors& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

PairedDifference paired(const SquaredErrors& worse, const SquaredErrors& better) {
  const double n = static_cast<double>(worse.size());
  PairedDifference difference;
  for (std::size_t i = 0; i < worse.size(); ++i) difference.mean += (worse[i] - better[i]) / n;
  double squares = 0.0;
  for (std::size_t i = 0; i < worse.size(); ++i) squares += std::pow(worse[i] - better[i] - difference.mean, 2);
  difference.standard_error = n > 1 ? std::sqrt(squares / (n - 1) / n) : std::numeric_limits<double>::infinity();
  return difference;
}

PoseEvaluator::PoseEvaluator(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot)
    : data_(data) {
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    const MeasurementRows measured = rows_of(pose);
    if (measured.points() + measured.distances == 0) continue;
    rows_ += measured.points() > 0 ? measured.points() : measured.distances;
    poses_.push_back(index);
    motions_.push_back(robot.motions(Stop(pose), pose.target));
  }
}

std::vector<JointVector> PoseEvaluator::corrected(const CorrectedRobot& robot) const {
  std::vector<JointVector> joints;
  joints.reserve(poses_.size());
  for (const std::size_t pose : poses_) joints.push_back(robot.corrected_joints(data_.poses[pose].joints));
  return joints;
}

std::vector<JointVector> PoseEvaluator::with(std::vector<JointVector> corrected, std::size_t joint,
                                             const JointCorrection& correction) const {
  const auto at = static_cast<Eigen::Index>(joint);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const JointVector& commanded = data_.poses[poses_[i]].joints;
    JointVector driven = driven_joints(data_.robot.chain, corrected[i]);
    driven[at] = driven_joints(data_.robot.chain, commanded)[at] + correction(commanded[at]);
    corrected[i] = commanded_joints(data_.robot.chain, driven);
  }
  return corrected;
}

SquaredErrors PoseEvaluator::squared_errors(const CorrectedRobot& robot,
                                            const std::vector<JointVector>& corrected) const {
  std::vector<Eigen::Isometry3d> predicted;
  predicted.reserve(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i)
    predicted.push_back(robot.predict(corrected[i], motions_[i], data_.poses[poses_[i]].target));
  SquaredErrors errors = tool_errors_m(robot, predicted, data_, poses_);
  for (double& error : errors) error = std::pow(millimetres(error), 2);
  return errors;
}

void add_short_forms(JointCandidates& candidates, const GpParameters& parameters) {
  FormulaRefiner forms(candidates.training.table, parameters);
  candidates.short_forms.clear();
  for (const Individual& individual : candidates.front) {
    candidates.short_forms.push_back(forms.simplified(individual.tree));
    candidates.short_forms.push_back(forms.fitted(candidates.short_forms.back()));
  }
}

Selection select_corrections(const DataSet& data, std::span<const std::size_t> fitted,
                             std::span<const std::size_t> selecting, const CorrectedRobot& declared,
                             std::span<const JointCandidates> candidates) {
  const PoseEvaluators evaluators{{data, selecting, declared}, {data, fitted, declared}};
  Selection start{declared, {}};
  for (const JointCandidates& joint : candidates) {
    start.choices.push_back(
        {static_cast<int>(joint.training.joint), false, joint.front.size() + joint.alternatives.size(), 0.0, 0.0});
  }
  Selection best = start;
  double least = sum(evaluators.selecting.squared_errors(declared));
  for (StartingPoint& from : starting_points(declared, candidates)) {
    std::vector<std::vector<JointCorrection>> admissible;
    for (const JointCandidates& joint : candidates) admissible.push_back(admissible_corrections(joint, from.set));
    start.robot = std::move(from.robot);
    const Selection swept = sweep(evaluators, start, candidates, admissible);
    const double left = sum(evaluators.selecting.squared_errors(swept.robot));
    if (left < least) {
      best = swept;
      least = left;
    }
  }
  return best;
}

}  // namespace demecal::inline calibration
