#include "diagnosis/detectable.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

}  // namespace demecal
