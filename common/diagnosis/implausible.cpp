#include "diagnosis/implausible.hpp"

#include <cmath>
#include <cstdio>

#include "diagnosis/judgement.hpp"

namespace demecal {
namespace {

constexpr double kLargestTurn_rad = 0.02;  ///< gears, bearings and links that give way more are broken
constexpr double kLargestShift_m = 0.02;
constexpr double kUnitShare = 0.02;  ///< off a whole share: the arm's own errors may hide that much of it

std::string with_three_places(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

/// Controllers that report a joint against the horizontal, or through a parallelogram, give its angle as a sum.
std::string unit_coupling(const Effect& effect) {
  if (effect.kind != "coupling" || effect.form != "linear") return {};
  const double share = effect.value(0);
  if (std::abs(std::abs(share) - 1.0) > kUnitShare) return {};
  const std::string joint = std::to_string(effect.joint + 1),
                    from = std::to_string(std::lround(effect.setting("from")));
  return "the data show a unit coupling: joint " + joint + " turns with joint " + from + ", " +
         with_three_places(share) + " of its motion; that is how joint " + joint +
         " is reported, not an error of the arm: write its column as the sum q" + joint +
         (share > 0 ? " + q" : " - q") + from;
}

}  // namespace

bool leans_too_far(const Effect& effect) {
  constexpr double kLargestLean = 0.36;  // tangent of 20 degrees
  if (effect.kind != "compliance" || effect.form != "tilted") return false;
  return std::hypot(effect.value(1), effect.value(2)) > kLargestLean * std::abs(effect.value(0));
}

std::string implausibility(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  const LargestMotion largest = largest_motion(effect, robot, states);
  if (largest.turn_rad <= kLargestTurn_rad && largest.shift_m <= kLargestShift_m)
    return leans_too_far(effect) ? "mounting tilt implausible (> 20 deg)" : "";
  if (const std::string coupled = unit_coupling(effect); !coupled.empty()) return coupled;
  return "implausibly large for a real arm (> " +
         std::string(largest.turn_rad > kLargestTurn_rad ? "20 mrad" : "20 mm") + "): check signs, units and row order";
}

}  // namespace demecal
