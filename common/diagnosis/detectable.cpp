#include "diagnosis/detectable.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/judgement.hpp"
#include "effects/likely_causes.hpp"

namespace demecal {
namespace {

constexpr double kPower90 = 1.2816;  ///< standard normal quantile of 0.9

bool holds(const CorrectedRobot& model, const Effect& effect) {
  return std::any_of(model.effects.begin(), model.effects.end(), [&](const Effect& present) {
    return present.kind == effect.kind && present.joint == effect.joint;
  });
}

double amplitude(const Candidate& candidate, const Score& score, const Detection& detection) {
  const auto place =
      static_cast<std::size_t>((1.0 - detection.family_error) * static_cast<double>(detection.null_maxima.size() - 1));
  const double price = 0.5 * static_cast<double>(score.rank) * std::log(static_cast<double>(detection.poses));
  const double least = 2.0 * (std::max(0.0, detection.null_maxima[place]) + price + candidate.name_nats);
  return (std::sqrt(least) + kPower90) * std::sqrt(detection.variance / score.smallest);
}

/// Marks what only an effect larger than plausible of its kind would show, over the states of the poses.
void mark_untestable(std::vector<NotFound>& not_found, const Robot& robot, const std::vector<ArmState>& states) {
  for (NotFound& missing : not_found) {
    Effect effect = missing.effect;
    effect.values.assign(law_of(effect).coefficients(effect, robot).size(), 0.0);
    effect.values.front() = missing.smallest_detectable;
    const LargestMotion needed = farthest_motion(effect, robot, states);
    const Cause& cause = cause_of(effect.kind);
    missing.testable = needed.turn_rad <= cause.largest_turn_rad && needed.shift_m <= cause.largest_shift_m;
  }
}

/// The candidates that were refused as larger than a real arm's effects.
std::vector<std::size_t> refused(const std::vector<Candidate>& candidates, const std::vector<Round>& rounds) {
  std::vector<std::size_t> found;
  for (const Round& round : rounds) {
    if (!round.implausible) continue;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const bool real = candidates[i].disguise == Disguise::none;
      if (real && candidates[i].effect.same_law_as(round.effect)) found.push_back(i);
    }
  }
  return found;
}

}  // namespace

std::vector<NotFound> smallest_detectable(const std::vector<Candidate>& candidates, const std::vector<Score>& scores,
                                          const CorrectedRobot& model, const Robot& robot, const Detection& detection) {
  std::vector<NotFound> all;
  if (detection.null_maxima.empty()) return all;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const Effect& effect = candidate.effect;
    if (effect.kind == "symbolic") continue;
    if (candidate.disguise != Disguise::none || scores[i].smallest <= 0.0 || holds(model, effect)) continue;
    const double size = amplitude(candidate, scores[i], detection);
    const auto same = std::find_if(all.begin(), all.end(), [&](const NotFound& other) {
      return other.effect.kind == effect.kind && other.effect.joint == effect.joint;
    });
    if (same == all.end()) {
      all.push_back({effect, size, law_of(effect).coefficients(effect, robot).front().unit});
    } else if (size > same->smallest_detectable && effect.form == same->effect.form) {
      same->smallest_detectable = size;
      same->effect = effect;
    }
  }
  return all;
}

std::vector<NotFound> not_found_beyond(const EndedLoop& loop, const std::vector<double>& null_maxima,
                                       const BoundOptions& options, RandomStream random) {
  Projection beyond = loop.at.projection;
  const std::vector<std::size_t> set_aside = refused(loop.candidates, loop.rounds);
  for (const std::size_t index : set_aside) {
    const auto count = loop.columns.spans()[index].count;
    const RowMatrix judging = RowMatrix::Zero(loop.at.judging.rows(), count);
    beyond.add(beyond.trial(loop.columns.dense(loop.at.fitted, index), judging));
  }
  const Scan scan(loop.columns, prices_nats(loop.candidates), loop.at.fitted, beyond);
  std::vector<double> maxima = null_maxima;
  if (!set_aside.empty()) maxima = scan.null_maxima(loop.columns, loop.at.fitted, beyond, options.permutations, random);
  std::vector<NotFound> all = smallest_detectable(loop.candidates, scan.scores(), loop.model, loop.robot,
                                                  {.null_maxima = maxima,
                                                   .family_error = options.family_error,
                                                   .variance = beyond.squares() / beyond.freedom(),
                                                   .poses = loop.at.fitted.poses.size()});
  mark_untestable(all, loop.robot, loop.at.fitted.states);
  return all;
}

}  // namespace demecal
