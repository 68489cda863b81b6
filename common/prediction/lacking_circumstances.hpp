// Effects that poses do not let a robot's model apply, since they do not state what these depend on.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline prediction {

struct LackingCircumstance {
  const Effect* effect = nullptr;            ///< of the robot
  const CircumstanceWords* words = nullptr;  ///< of what is lacking
  std::size_t without = 0;                   ///< poses that do not state it
  std::size_t poses = 0;                     ///< in all
};

/// Of every effect of `robot` what some of `poses` do not state, effect by effect.
std::vector<LackingCircumstance> lacking_circumstances(const CorrectedRobot& robot, const DataSet& data,
                                                       std::span<const std::size_t> poses);

/// A sentence for people, without its full stop.
std::string to_string(const LackingCircumstance& lacking);

}  // namespace demecal::inline prediction
