#include "closed_calibration/loop_passes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/selection.hpp"
#include "effects/effect.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline closed_calibration {
namespace {

std::vector<Decoy> joined_decoys(std::vector<Decoy> earlier, const std::vector<Decoy>& later) {
  for (const Decoy& decoy : later) {
    const auto same = std::ranges::find(earlier, decoy.name, &Decoy::name);
    if (same == earlier.end()) {
      earlier.push_back(decoy);
      continue;
    }
    same->best_gain_nats = std::max(same->best_gain_nats, decoy.best_gain_nats);
    same->won = same->won || decoy.won;
  }
  return earlier;
}

/// Each share is of what its own pass began with.
std::optional<double> joined_share(std::optional<double> earlier, std::optional<double> later) {
  if (!earlier || !later) return earlier ? earlier : later;
  return 1.0 - (1.0 - *earlier) * (1.0 - *later);
}

constexpr double kSignificantDeviations = 2.0;  ///< standard errors

}  // namespace

bool added_any(const LoopOutcome& outcome) {
  return std::ranges::any_of(outcome.rounds, [](const Round& round) { return round.verdict == Verdict::added; });
}

LoopOutcome joined(LoopOutcome earlier, LoopOutcome later) {
  const int rounds = static_cast<int>(earlier.rounds.size());
  const int groups = earlier.rounds.empty() ? 0 : earlier.rounds.back().group;
  for (Round& round : later.rounds) {
    round.number += rounds;
    round.group += groups;
  }
  later.rounds.insert(later.rounds.begin(), earlier.rounds.begin(), earlier.rounds.end());
  later.dropped.insert(later.dropped.begin(), earlier.dropped.begin(), earlier.dropped.end());
  later.decoys = joined_decoys(std::move(earlier.decoys), later.decoys);
  if (later.independent_m == 0.0) {
    later.noise = earlier.noise;
    later.independent_m = earlier.independent_m;
  }
  if (earlier.lack_of_fit_p) later.lack_of_fit_p = earlier.lack_of_fit_p;
  later.explained_share = joined_share(earlier.explained_share, later.explained_share);
  return later;
}

CorrectedRobot without_formulas(const CorrectedRobot& robot) {
  CorrectedRobot bare = robot;
  std::erase_if(bare.effects, is_symbolic);
  return bare;
}

bool needs_formula_search(const LoopOutcome& loop, const CorrectedRobot& robot, const ClosedLoopOptions& options) {
  const bool wanted = options.candidates.empty() || std::ranges::count(options.candidates, symbolic_kind()) > 0;
  const bool at_its_end = loop.stopped == StopReason::no_gain || loop.stopped == StopReason::no_structure;
  const bool left = loop.p_structure_left <= options.family_error;
  return wanted && at_its_end && (left || std::ranges::any_of(robot.effects, is_symbolic));
}

double description_nats(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses,
                        const std::vector<Candidate>& candidates) {
  const PoseEvaluator evaluator(data, poses, robot);
  const double squares = sum(evaluator.squared_errors(robot));
  double nats = 0.5 * evaluator.rows() * std::log(std::max(squares, 1e-300));
  for (const Effect& effect : robot.effects) {
    nats += 0.5 * static_cast<double>(effect.values.size()) * std::log(static_cast<double>(poses.size())) +
            naming_cost_nats(effect, candidates);
  }
  return nats;
}

bool describes_better(const CorrectedRobot& robot, const CorrectedRobot& present, const DataSet& data,
                      const std::vector<Candidate>& candidates) {
  const std::vector<std::size_t> fitted = without_gross_errors(data, PoseSet::calibration, present);
  if (!(description_nats(robot, data, fitted, candidates) < description_nats(present, data, fitted, candidates))) {
    return false;
  }
  const std::vector<std::size_t> validation = without_gross_errors(data, PoseSet::validation, present);
  const PairedDifference behind = paired(PoseEvaluator(data, validation, robot).squared_errors(robot),
                                         PoseEvaluator(data, validation, present).squared_errors(present));
  return validation.empty() || behind.mean <= kSignificantDeviations * behind.standard_error;
}

void append_rejected_rounds(const LoopOutcome& pass, const CorrectedRobot& kept, LoopOutcome& outcome) {
  const int group = outcome.rounds.empty() ? 1 : outcome.rounds.back().group + 1;
  for (Round round : pass.rounds) {
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(round.effect); };
    if (round.verdict != Verdict::added || std::ranges::any_of(kept.effects, is_it)) continue;
    round.verdict = Verdict::rejected;
    round.reason = "the model without it describes the poses better";
    round.number = static_cast<int>(outcome.rounds.size()) + 1;
    round.group = group;
    outcome.rounds.push_back(std::move(round));
  }
}

}  // namespace demecal::inline closed_calibration
