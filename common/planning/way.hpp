// By which way the arm gets from pose to pose: straight where that is free, else through places that it may pass.
#pragma once

#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// One stop of the way.
struct WayStop {
  JointVector joints;
  int pose = -1;  ///< which pose is measured here; -1: only passed
};

struct MeasuringWay {
  std::vector<WayStop> stops;
  std::vector<std::size_t> blocked;  ///< poses that no free way was found to; no stop is theirs
};

/// The way along `poses` in their order: to each through its approach stop, with other stops between where the straight
/// way is not free. Where no free way joins all, it goes along as many as are joined.
MeasuringWay way_along(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream random);

}  // namespace demecal::inline planning
