// Dividing poses into sets at random, where the user has not.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "data/pose.hpp"

namespace demecal {

/// Fractions of the poses, each 0 to 1; the rest is for calibration.
struct SplitFractions {
  double validation = 0.3;
  double accept = 0.0;
};

/// A random index below its argument.
using DrawIndex = std::function<std::size_t(std::size_t)>;

/// Sets every pose's set, by pose id: repeats stay together. Each set gets its fraction of the ids, rounded;
/// calibration keeps one at least. Equal draws give equal sets.
void split_by_pose(std::span<MeasuredPose> poses, const SplitFractions& fractions, const DrawIndex& draw);

}  // namespace demecal
