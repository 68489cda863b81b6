// Effects of a model that poses do not let it apply, since they lack what the effects depend on.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/corrected_robot.hpp"

namespace demecal {

/// An effect, what it needs, and how many poses lack that: there the model predicts as if the effect were not.
struct UnappliedEffect {
  std::string kind;
  int joint = -1;          ///< from 0; -1: of the whole arm
  std::string lacking;     ///< "approach", "payload", "temperature" or "time"
  std::size_t poses = 0;   ///< without it
  std::size_t of_all = 0;  ///< poses of the data set

  /// "Backlash of joint 2 is not applied at 30 of 30 poses: they have no approach direction."
  std::string sentence() const;
};

/// In the order of the model's effects.
std::vector<UnappliedEffect> unapplied_effects(const CorrectedRobot& robot, const DataSet& data);

}  // namespace demecal
