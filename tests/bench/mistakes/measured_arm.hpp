// Arms that are measured in the benchmark of mistakes: how wrong they are, and how their poses are measured.
#pragma once

#include <array>

#include "data/data_set.hpp"
#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"

namespace demecal::bench {

/// How wrong an arm is, in multiples of what is usual, and how it is measured.
struct Make {
  std::array<int, 3> poses{50, 25, 25};
  double wrongness = 1.0;
  double range_share = 0.6;  ///< of each joint's range
  int repeats = 1;
  bool orientation = false, warm = false, base_frame = false;
};

/// An arm of seven joints with a shoulder, elbow and wrist whose axes meet, as lightweight arms have them.
Robot seven_joints();

/// Links, tool, gears and compliance wrong as real ones are.
Scenario scenario_of(const Robot& robot, const Make& make, RandomStream& random);

/// Poses measured, and dealt to the sets at random.
DataSet dealt(const Scenario& scenario);

/// The same poses measured at several points of the tool, one row each.
DataSet with_targets(const Robot& robot, const Scenario& scenario);

}  // namespace demecal::bench
