#include "calibration/selection.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/jury.hpp"
#include "fitting/median.hpp"

namespace demecal {
namespace {

constexpr int kSweeps = 5;
constexpr double kMostOverTarget = 3.0;
constexpr double kEarned = 2.0;  ///< standard errors of the gain: about one false keep in forty

struct Trial {
  JointCorrection correction;
  std::size_t length = 0;
  SquaredErrors errors;
  double sum = 0.0;
};

/// The target error that one row in twenty exceeds: the largest ones are often poses near a singularity.
double large_target_rad(const JointTraining& training) {
  std::vector<double> sizes;
  const double least = training.table.loss == Loss::squared ? median(training.table.weight) : 1.0;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] >= least) sizes.push_back(std::abs(training.table.target[row]));
  }
  if (sizes.empty()) return 0.0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place * training.scale_rad;
}

bool is_below(const JointCorrection& correction, double large_rad) {
  return magnitude_bound(correction.formula(), correction.range_rad()) <= kMostOverTarget * large_rad;
}

/// A joint's candidates: those evolved, then those from elsewhere.
std::vector<Trial> trials_of(const JointCandidates& candidates) {
  std::vector<Trial> trials;
  const double large_rad = large_target_rad(candidates.training);
  const auto add = [&](const JointCorrection& correction, std::size_t length) {
    if (is_below(correction, large_rad)) trials.push_back({correction, length, {}, 0.0});
  };
  for (const Individual& individual : candidates.front) {
    add(correction_from(candidates.training, individual.tree), individual.tree.size());
  }
  for (const JointCorrection& other : candidates.others) {
    if (!other.is_neutral()) add(other, other.formula().size());
  }
  return trials;
}

std::vector<Trial> try_all(const Jury& deciding, const CorrectedRobot& robot, const std::vector<JointVector>& neutral,
                           const JointCandidates& candidates) {
  std::vector<Trial> trials = trials_of(candidates);
  for (Trial& trial : trials) {
    const auto joints = deciding.with(neutral, candidates.training.joint, trial.correction);
    trial.errors = deciding.squared_errors(robot, joints);
    trial.sum = sum(trial.errors);
  }
  std::erase_if(trials, [](const Trial& trial) { return !std::isfinite(trial.sum); });
  return trials;
}

/// The shortest trial not significantly worse than the best; null where there is none.
const Trial* frugal(const std::vector<Trial>& trials) {
  const auto best =
      std::min_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.sum < b.sum; });
  const Trial* chosen = nullptr;
  for (const Trial& trial : trials) {
    const PairedDifference behind = paired(trial.errors, best->errors);
    const bool close = &trial == &*best || behind.mean <= 0.5 * behind.standard_error;
    if (close && (chosen == nullptr || trial.length < chosen->length)) chosen = &trial;
  }
  return chosen;
}

/// Poses by what they are asked.
struct Juries {
  Jury deciding;
  Jury fitted;
};

/// Whether a gain is beyond doubt.
bool earns_its_place(const PairedDifference& gain) {
  return gain.mean > kEarned * gain.standard_error;
}

/// The fall of the error from joints at which one is neutral to those with its correction.
PairedDifference gain_of(const Jury& jury, const CorrectedRobot& robot, const std::vector<JointVector>& neutral,
                         std::size_t joint, const JointCorrection& correction) {
  return paired(jury.squared_errors(robot, neutral), jury.squared_errors(robot, jury.with(neutral, joint, correction)));
}

/// The correction this joint is best given while the others stand as they do in `robot`.
JointCorrection choose(const Juries& juries, CorrectedRobot robot, const JointCandidates& candidates,
                       JointChoice& choice) {
  const std::size_t joint = candidates.training.joint;
  robot.corrections[joint] = JointCorrection{};
  const std::vector<JointVector> neutral = juries.deciding.corrected(robot);
  const std::vector<Trial> trials = try_all(juries.deciding, robot, neutral, candidates);
  const Trial* chosen = frugal(trials);
  choice.kept = false;
  if (chosen == nullptr) return {};
  const PairedDifference gain = paired(juries.deciding.squared_errors(robot, neutral), chosen->errors);
  choice.kept = earns_its_place(gain) && earns_its_place(gain_of(juries.fitted, robot, juries.fitted.corrected(robot),
                                                                 joint, chosen->correction));
  choice.gain_mm2 = gain.mean;
  choice.gain_error_mm2 = gain.standard_error;
  return choice.kept ? chosen->correction : JointCorrection{};
}

bool same(const JointCorrection& a, const JointCorrection& b) {
  return a.is_neutral() == b.is_neutral() && a.formula() == b.formula();
}

/// Sweeps over the joints from the corrections in `selection.robot` until nothing changes.
Selection settle(const Juries& juries, Selection selection, std::span<const JointCandidates> candidates) {
  bool changed = true;
  for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      JointCorrection& present = selection.robot.corrections[candidates[i].training.joint];
      const JointCorrection next = choose(juries, selection.robot, candidates[i], selection.choices[i]);
      changed = changed || !same(present, next);
      present = next;
    }
  }
  return selection;
}

/// Every joint with what fits its own targets best: the targets belong together, one joint's with another's.
CorrectedRobot all_fittest(CorrectedRobot robot, std::span<const JointCandidates> candidates) {
  for (const JointCandidates& joint : candidates) {
    const double large_rad = large_target_rad(joint.training);
    for (const Individual& individual : joint.front) {  // falling fitness: the last one that is bounded stays
      const JointCorrection correction = correction_from(joint.training, individual.tree);
      if (is_below(correction, large_rad)) robot.corrections[joint.training.joint] = correction;
    }
  }
  return robot;
}

/// Every joint with its candidate from elsewhere at place `set`, where it has one.
CorrectedRobot with_others(CorrectedRobot robot, std::span<const JointCandidates> candidates, std::size_t set) {
  for (const JointCandidates& joint : candidates) {
    if (set >= joint.others.size() || !is_bounded(joint.others[set], joint.training)) continue;
    robot.corrections[joint.training.joint] = joint.others[set];
  }
  return robot;
}

std::vector<CorrectedRobot> starts_of(const CorrectedRobot& declared, std::span<const JointCandidates> candidates) {
  std::vector<CorrectedRobot> starts{declared, all_fittest(declared, candidates)};
  std::size_t sets = 0;
  for (const JointCandidates& joint : candidates) sets = std::max(sets, joint.others.size());
  for (std::size_t set = 0; set < sets; ++set) starts.push_back(with_others(declared, candidates, set));
  return starts;
}

}  // namespace

bool is_bounded(const JointCorrection& correction, const JointTraining& training) {
  return is_below(correction, large_target_rad(training));
}

Selection select_corrections(const DataSet& data, std::span<const std::size_t> fitted,
                             std::span<const std::size_t> deciding, const CorrectedRobot& declared,
                             std::span<const JointCandidates> candidates) {
  const Juries juries{{data, deciding, declared}, {data, fitted, declared}};
  Selection start{declared, {}};
  for (const JointCandidates& joint : candidates) {
    start.choices.push_back(
        {static_cast<int>(joint.training.joint), false, joint.front.size() + joint.others.size(), 0.0, 0.0});
  }
  Selection best = start;
  double least = sum(juries.deciding.squared_errors(declared));
  for (CorrectedRobot& from : starts_of(declared, candidates)) {
    start.robot = std::move(from);
    const Selection settled = settle(juries, start, candidates);
    const double left = sum(juries.deciding.squared_errors(settled.robot));
    if (left < least) {
      best = settled;
      least = left;
    }
  }
  return best;
}

}  // namespace demecal
