// Poses read off a controller's display against a description of its arm: what of the description does not fit.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"

namespace demecal::inline data_check {

/// How a description and a controller agree.
struct PendantComparison {
  std::vector<double> errors_m;         ///< of each pose: from the described tool point to the one read off
  bool agrees = false;                  ///< all within kPendantRounding_m
  bool explained = false;               ///< agrees, or does with what `findings` say
  std::vector<std::string> findings{};  ///< where it agrees: what these poses leave untested
};

/// Controllers show a hundredth of a millimetre and of a degree, which turns a long arm by some tenths.
inline constexpr double kPendantRounding_m = 3e-4;

/// The fewest poses that tell more than base and tool do.
inline constexpr std::size_t kFewestPendantPoses = 6;

/// `data` holds joints and the positions that the controller states for them in its base frame: numbers of its own
/// kinematics, so that a right description agrees with them to their rounding. Where it does not, the simplest change
/// that does is named: the tool point or the base frame alone; joints' signs, exchanges, sums, the convention, units,
/// signs of several joints and mirrored axes last of these; a single pose that was not read off as it stands; one
/// length or angle; zeros of joints; link lengths. With fewer than kFewestPendantPoses only errors are told, and that.
PendantComparison compare_with_pendant(const DataSet& data);

/// Where the positions agree once they are read as metres or centimetres, and what their last digit then hides is
/// allowed for: says so in `result`.
void explain_by_rounded_unit(const DataSet& data, PendantComparison& result);

}  // namespace demecal::inline data_check
