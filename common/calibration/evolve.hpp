// How a calibration has formulas evolved without knowing where the islands are.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"

namespace demecal {

/// What an evolution is for: for those who watch, not for the islands, which must not know that a search is in vain.
enum class Sought {
  corrections,  ///< of each joint, from its own value
  formulas,     ///< over all that a joint's error may depend on
  luck          ///< the same on permuted residuals
};

/// Evolves candidates for every joint of a training; nothing where that could not be done to the end.
using Evolve = std::function<std::optional<std::vector<JointCandidates>>(const std::vector<JointTraining>&, Sought)>;

/// Evolves joint corrections for what stands before them; nothing where that could not be done to the end.
using LearnCorrections = std::function<std::optional<std::vector<JointCandidates>>(const Preparation&)>;

}  // namespace demecal
