// What the closed loop found, round by round, with the number behind every step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "next_measurement/next_measurement.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline diagnosis {

enum class Verdict { added, rejected, none };

/// One step of the loop: the best candidate, and what became of it.
struct Round {
  int number = 0;  ///< from 1
  int group = 0;   ///< rounds of one group were held against the same draws of the noise and refitted together; from 1
  Verdict verdict = Verdict::none;
  Effect effect;              ///< with its values at the end of its group; of the best candidate where none was added
  std::string diagnosis;      ///< one sentence for an engineer
  std::string formula;        ///< one line
  std::string reason;         ///< why it was not added; empty where it was
  bool implausible = false;   ///< refused as larger than a real arm's: the data hold it, so that it has no bound
  std::vector<Rival> rivals;  ///< nearest first
  double p_structure = 1.0;   ///< of the omnibus test for dependence before this group
  double p_family = 1.0;      ///< family-wise, over all candidates or, of an evolved formula, over whole searches
  int null_draws = 0;         ///< behind p_family; of an evolved formula: searches in permuted poses
  double gain_nats = 0.0;     ///< of the description length
  double confirmed = 0.0;     ///< share of it that the validation poses bear out; above 0.5 they gain by it
  double confirmed_lower = 0.0;                 ///< one-sided 95 % bound of that share
  double sign_stability = 0.0;                  ///< share of resamples in which the leading coefficient keeps its sign
  std::vector<std::array<double, 2>> interval;  ///< 95 % of every coefficient; SI. Of added effects: beside all others
  double validation_before_mm = 0.0;            ///< mean tool error on the validation poses
  double validation_after_mm = 0.0;
  std::optional<NextMeasurement> next_measurement;  ///< where there are rivals
};

/// An effect that was looked for and not found.
struct NotFound {
  Effect effect;                     ///< kind and joint
  double smallest_detectable = 0.0;  ///< the smallest amplitude that these poses would show with power 0.9
  std::string unit;                  ///< "rad", "rad/Nm", ...
  bool testable = true;  ///< an effect that small is plausible of its kind; else these data tell nothing of it
};

/// A kind of effect that these data cannot show at all.
struct UntestableKind {
  std::string kind;
  std::string reason;  ///< "no approach columns: ..."
};

/// A candidate that cannot be true, and how it fared.
struct Decoy {
  std::string name;             ///< "backlash of joint 2 by shuffled approach signs"
  double best_gain_nats = 0.0;  ///< over all groups
  bool won = false;
  double p_left = 1.0;  ///< how often noise alone explains as much as it does once nothing real is added any more
};

enum class StopReason { not_run, no_structure, no_gain, max_effects, decoy };

struct LoopOutcome {
  StopReason stopped = StopReason::not_run;
  std::vector<Round> rounds;
  std::vector<Effect> dropped;  ///< added and taken back
  std::vector<NotFound> not_found;
  std::vector<UntestableKind> untestable;
  std::vector<std::string> considered{};  ///< kinds, where not all of the catalogue were
  std::vector<Decoy> decoys;
  std::vector<std::size_t> outliers;       ///< poses (in the data set) that were down-weighted as far out
  std::optional<double> repeat_scatter_m;  ///< per axis, of repeated calibration poses
  std::optional<double> lack_of_fit_p;     ///< of the F test against repeats, before the loop
  std::optional<double> explained_share;   ///< 1 - (MS_res - MS_pe) / (MS_start - MS_pe), with repeats
  double p_structure_left = 1.0;           ///< of the omnibus test at the end
  NoiseModel noise;                        ///< of the measurements about the model at the end
  bool noise_estimated = false;            ///< else poses were taken to scatter independently
  double independent_m = 0.0;              ///< standard deviation of the positions' independent noise
  int candidates = 0;                      ///< effects tried in every round
  int null_draws = 0;
};

/// Whether the effect of this one of `rounds` was added, or considered last, and has rivals.
inline bool is_ambiguous(const Round& round, const std::vector<Round>& rounds) {
  return (round.verdict == Verdict::added || &round == &rounds.back()) && !round.rivals.empty();
}

/// The effects of such rounds, as propose_poses() asks for them.
inline std::vector<AmbiguousEffect> ambiguous_effects(const std::vector<Round>& rounds) {
  std::vector<AmbiguousEffect> effects;
  for (const Round& round : rounds)
    if (is_ambiguous(round, rounds)) effects.push_back({round.effect, round.rivals});
  return effects;
}

/// The 95 % interval of every coefficient by its standard error (normal); nothing where standard errors are unknown.
inline std::vector<std::array<double, 2>> confidence_intervals(const Effect& effect) {
  constexpr double kNormal95 = 1.96;
  std::vector<std::array<double, 2>> intervals;
  for (std::size_t i = 0; i < effect.standard_errors.size(); ++i) {
    const double half = kNormal95 * effect.standard_errors[i];
    intervals.push_back({effect.value(i) - half, effect.value(i) + half});
  }
  return intervals;
}

/// The word for a reason in files.
inline std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::no_structure:
      return "no_structure";
    case StopReason::no_gain:
      return "no_gain";
    case StopReason::max_effects:
      return "max_effects";
    case StopReason::decoy:
      return "decoy";
    case StopReason::not_run:
      break;
  }
  return "not_run";
}

/// The word for a verdict in files.
inline std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::added:
      return "added";
    case Verdict::rejected:
      return "rejected";
    case Verdict::none:
      break;
  }
  return "none";
}

}  // namespace demecal::inline diagnosis
