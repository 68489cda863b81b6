#include "updating/known_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace demecal::inline updating {

std::vector<KnownPlace> known_places(const CalibratedModel& model, int joint) {
  constexpr double kStep_rad = 0.035;
  /// To which a joint is known at one place at best; of a fleet, to which its robots' spread tells it.
  constexpr double kKnown_rad = 3e-5, kTold_rad = 3e-6;
  constexpr double kByOnePose_rad = 3e-4;  ///< to which one pose there shows it beside all else that it shows
  const double best = model.fleet ? kTold_rad : kKnown_rad;
  std::vector<KnownPlace> places;
  if (const auto counts = model.pose_counts.find(joint); counts != model.pose_counts.end()) {
    for (double theta = 0.0; theta < 2.0 * std::numbers::pi; theta += kStep_rad) {
      const double poses = counts->second[turn_step(theta)] * kStep_rad / kTurnStep_rad;
      if (poses > 0.0) places.push_back({theta, best * best + kByOnePose_rad * kByOnePose_rad / poses});
    }
    return places;
  }
  const auto at = static_cast<std::size_t>(joint);
  if (at >= model.measured.size()) return places;
  const double width = std::min(model.measured[at].upper - model.measured[at].lower, 2.0 * std::numbers::pi);
  for (double passed = 0.0; passed <= width; passed += kStep_rad)
    places.push_back({model.measured[at].lower + passed, best * best});
  return places;
}

}  // namespace demecal::inline updating
