#include "calibration/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "effects/measurement.hpp"

namespace demecal {
namespace {

constexpr int kSweeps = 5;
constexpr double kMostOverTarget = 3.0;
constexpr double kEarned = 2.0;  ///< standard errors of the gain: about one false keep in forty

using SquaredErrors = std::vector<double>;  ///< mm^2, one per deciding pose

SquaredErrors squared_errors(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses) {
  SquaredErrors errors;
  errors.reserve(poses.size());
  for (const std::size_t pose : poses) errors.push_back(std::pow(1e3 * tool_error_m(robot, data, data.poses[pose]), 2));
  return errors;
}

double sum(const SquaredErrors& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

struct PairedDifference {
  double mean = 0.0;
  double standard_error = 0.0;
};

/// Of `worse` minus `better`, pose by pose.
PairedDifference paired(const SquaredErrors& worse, const SquaredErrors& better) {
  const double n = static_cast<double>(worse.size());
  PairedDifference difference;
  for (std::size_t i = 0; i < worse.size(); ++i) difference.mean += (worse[i] - better[i]) / n;
  double squares = 0.0;
  for (std::size_t i = 0; i < worse.size(); ++i) squares += std::pow(worse[i] - better[i] - difference.mean, 2);
  difference.standard_error = n > 1 ? std::sqrt(squares / (n - 1) / n) : std::numeric_limits<double>::infinity();
  return difference;
}

struct Trial {
  JointCorrection correction;
  std::size_t length = 0;
  SquaredErrors errors;
  double sum = 0.0;
};

/// The target error that one row in twenty exceeds: the largest ones are often poses near a singularity.
double large_target_rad(const JointTraining& training) {
  std::vector<double> sizes;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] == 1.0) sizes.push_back(std::abs(training.table.target[row]));
  }
  if (sizes.empty()) return 0.0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place * training.scale_rad;
}

bool is_bounded(const JointCorrection& correction, double large_rad) {
  return magnitude_bound(correction.formula(), correction.range_rad()) <= kMostOverTarget * large_rad;
}

std::vector<Trial> try_all(const DataSet& data, std::span<const std::size_t> deciding, CorrectedRobot robot,
                           const JointCandidates& candidates) {
  std::vector<Trial> trials;
  const double large_rad = large_target_rad(candidates.training);
  for (const Individual& individual : candidates.front) {
    Trial trial{correction_from(candidates.training, individual.tree), individual.tree.size(), {}, 0.0};
    if (!is_bounded(trial.correction, large_rad)) continue;
    robot.corrections[candidates.training.joint] = trial.correction;
    trial.errors = squared_errors(robot, data, deciding);
    trial.sum = sum(trial.errors);
    if (std::isfinite(trial.sum)) trials.push_back(std::move(trial));
  }
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
  std::span<const std::size_t> deciding;
  std::span<const std::size_t> fitted;
};

/// Whether putting `with` in place of `without` lowers the error beyond doubt.
bool earns_its_place(const PairedDifference& gain) {
  return gain.mean > kEarned * gain.standard_error;
}

/// The correction this joint is best given while the others stand as they do in `robot`.
JointCorrection choose(const DataSet& data, const Juries& juries, CorrectedRobot robot,
                       const JointCandidates& candidates, JointChoice& choice) {
  JointCorrection& correction = robot.corrections[candidates.training.joint];
  correction = JointCorrection{};
  const SquaredErrors neutral = squared_errors(robot, data, juries.deciding);
  const SquaredErrors neutral_fitted = squared_errors(robot, data, juries.fitted);
  const std::vector<Trial> trials = try_all(data, juries.deciding, robot, candidates);
  const Trial* chosen = frugal(trials);
  choice.kept = false;
  if (chosen == nullptr) return {};
  correction = chosen->correction;
  const PairedDifference gain = paired(neutral, chosen->errors);
  choice.kept =
      earns_its_place(gain) && earns_its_place(paired(neutral_fitted, squared_errors(robot, data, juries.fitted)));
  choice.gain_mm2 = gain.mean;
  choice.gain_error_mm2 = gain.standard_error;
  return choice.kept ? chosen->correction : JointCorrection{};
}

bool same(const JointCorrection& a, const JointCorrection& b) {
  return a.is_neutral() == b.is_neutral() && a.formula() == b.formula();
}

/// Sweeps over the joints from the corrections in `selection.robot` until nothing changes.
Selection settle(const DataSet& data, const Juries& juries, Selection selection,
                 std::span<const JointCandidates> candidates) {
  bool changed = true;
  for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
    changed = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      JointCorrection& present = selection.robot.corrections[candidates[i].training.joint];
      const JointCorrection next = choose(data, juries, selection.robot, candidates[i], selection.choices[i]);
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
      if (is_bounded(correction, large_rad)) robot.corrections[joint.training.joint] = correction;
    }
  }
  return robot;
}

}  // namespace

Selection select_corrections(const DataSet& data, std::span<const std::size_t> fitted,
                             std::span<const std::size_t> deciding, const CorrectedRobot& declared,
                             std::span<const JointCandidates> candidates) {
  Selection start{declared, {}};
  for (const JointCandidates& joint : candidates) {
    start.choices.push_back({static_cast<int>(joint.training.joint), false, joint.front.size(), 0.0, 0.0});
  }
  Selection best = start;
  double least = sum(squared_errors(declared, data, deciding));
  for (const CorrectedRobot& from : {declared, all_fittest(declared, candidates)}) {
    start.robot = from;
    const Selection settled = settle(data, {deciding, fitted}, start, candidates);
    const double left = sum(squared_errors(settled.robot, data, deciding));
    if (left < least) {
      best = settled;
      least = left;
    }
  }
  return best;
}

}  // namespace demecal
