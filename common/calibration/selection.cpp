#include "calibration/selection.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/correction_limit.hpp"
#include "calibration/jury.hpp"
#include "evolution/model_archive.hpp"
#include "expression/bound.hpp"

namespace demecal {
namespace {

constexpr int kSweeps = 5;
constexpr double kEarned = 2.0;  ///< standard errors of the gain: about one false keep in forty

struct Trial {
  JointCorrection correction;
  SquaredErrors errors;
  double sum = 0.0;
};

bool is_below(const JointCorrection& correction, double limit_rad) {
  return stays_within(correction.formula(), correction.range_rad(), limit_rad);
}

/// A joint's candidates: those evolved, then those from elsewhere.
std::vector<Trial> trials_of(const JointCandidates& candidates) {
  std::vector<Trial> trials;
  const double limit_rad = correction_limit_rad(candidates.training);
  const auto add = [&](const JointCorrection& correction) {
    if (is_below(correction, limit_rad)) trials.push_back({correction, {}, 0.0});
  };
  for (const Individual& individual : candidates.front) {
    add(correction_from(candidates.training, individual.tree));
  }
  for (const Tree& tree : candidates.brief) add(correction_from(candidates.training, tree));
  for (const JointCorrection& other : candidates.others) {
    if (!other.is_neutral()) add(other);
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

/// The trial of the briefest description; of equals the first. Null where there is none.
const Trial* briefest(const std::vector<Trial>& trials, double rows) {
  const auto nats = [rows](const Trial& trial) {
    return description_length_nats(trial.correction.formula(), std::max(trial.sum, 1e-300), rows);
  };
  const auto best = std::ranges::min_element(trials, {}, nats);
  return best == trials.end() ? nullptr : &*best;
}

/// The shortest trial not significantly worse than the best; null where there is none.
const Trial* frugal(const std::vector<Trial>& trials) {
  const auto best = std::ranges::min_element(trials, {}, &Trial::sum);
  const Trial* chosen = nullptr;
  const auto length = [](const Trial& trial) { return trial.correction.formula().size(); };
  for (const Trial& trial : trials) {
    const PairedDifference behind = paired(trial.errors, best->errors);
    const bool close = &trial == &*best || behind.mean <= 0.5 * behind.standard_error;
    if (close && (chosen == nullptr || length(trial) < length(*chosen))) chosen = &trial;
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
  // Formulas of distal learning lean on the other joints': each alone leaves too much error to pay for itself.
  const bool is_distal = candidates.training.table.loss == Loss::squared;
  const Trial* chosen = is_distal ? frugal(trials) : briefest(trials, juries.deciding.rows());
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
    const double limit_rad = correction_limit_rad(joint.training);
    for (const Individual& individual : joint.front) {  // falling fitness: the last one that is bounded stays
      const JointCorrection correction = correction_from(joint.training, individual.tree);
      if (is_below(correction, limit_rad)) robot.corrections[joint.training.joint] = correction;
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

void write_briefly(JointCandidates& candidates, const GpParameters& parameters) {
  FormulaRefiner forms(candidates.training.table, parameters);
  candidates.brief.clear();
  for (const Individual& individual : candidates.front) {
    candidates.brief.push_back(forms.simplified(individual.tree));
    candidates.brief.push_back(forms.fitted(candidates.brief.back()));
  }
}

bool is_bounded(const JointCorrection& correction, const JointTraining& training) {
  return is_below(correction, correction_limit_rad(training));
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
