// What is left of the error: noise, and what nothing that was found explains.
#pragma once

#include <optional>
#include <string>

namespace demecal::inline report {

/// Components of the measurements' noise: 0 where there is none of the kind.
struct NoiseEntry {
  std::optional<double> independent_mm;
  bool estimated = false;  ///< else poses were taken to scatter independently
  std::optional<double> joint_repeatability_mrad, shared_by_repeats_mm, shared_in_order_mm, correlation_in_order;
};

/// Root mean squares of tool errors at validation poses.
struct UnexplainedEntry {
  std::optional<double> error_mm;  ///< neither noise nor explained
  std::optional<double> left_mm;   ///< with everything that was found
  std::optional<double> noise_mm;  ///< that would be left of a model without any error
  std::string advice;
};

struct Report;

/// Where more than half of the mean square that is left at validation poses is no noise: by what repeats of poses show,
/// or else by what the loop found to be independent from pose to pose beside an error that goes with the joints. What
/// the numbers' own uncertainty adds is none of it. Nothing of fewer than ten validation poses, of poses that measure
/// no points, and where the noise was not estimated.
std::optional<UnexplainedEntry> unexplained_error(const Report& report);

/// "Not explained: 0.260 mm of the error: 0.297 mm are left on validation poses, of which noise makes 0.144 mm."
std::string unexplained_sentence(const UnexplainedEntry& unexplained);

}  // namespace demecal::inline report
