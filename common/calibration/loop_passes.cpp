#include "calibration/loop_passes.hpp"

#include <algorithm>

namespace demecal {
namespace {

std::vector<Decoy> joined(std::vector<Decoy> earlier, const std::vector<Decoy>& later) {
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
std::optional<double> joined(std::optional<double> earlier, std::optional<double> later) {
  if (!earlier || !later) return earlier ? earlier : later;
  return 1.0 - (1.0 - *earlier) * (1.0 - *later);
}

const Effect* held(const CorrectedRobot& model, const Effect& effect) {
  const auto found = std::ranges::find_if(model.effects, [&](const Effect& one) { return one.same_law_as(effect); });
  return found == model.effects.end() ? nullptr : &*found;
}

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
  later.decoys = joined(std::move(earlier.decoys), later.decoys);
  if (later.independent_m == 0.0) {
    later.noise = earlier.noise;
    later.independent_m = earlier.independent_m;
  }
  if (earlier.lack_of_fit_p) later.lack_of_fit_p = earlier.lack_of_fit_p;
  later.explained_share = joined(earlier.explained_share, later.explained_share);
  return later;
}

void tell_of(LoopOutcome& outcome, const CorrectedRobot& model, const Robot& described) {
  for (Round& round : outcome.rounds) {
    if (round.verdict != Verdict::added) continue;
    if (const Effect* effect = held(model, round.effect)) {
      round.effect = *effect;
      if (!effect->standard_errors.empty()) round.interval = confidence_intervals(*effect);
      round.diagnosis = law_of(*effect).diagnosis(*effect, described);
      round.formula = law_of(*effect).formula(*effect, described);
    } else {
      round.verdict = Verdict::rejected;
      round.reason = "taken back: the model that was kept does without it";
    }
  }
}

}  // namespace demecal
