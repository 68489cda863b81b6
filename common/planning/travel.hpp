// In which order to visit poses, and by which way from one to the next.
#pragma once

#include <cstddef>
#include <vector>

#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// How far the joint is that moves most, rad; a metre of a prismatic joint counts as 2 rad.
double travel(const Chain& chain, const JointVector& from, const JointVector& to);

/// Indices of the poses in an order of short travel: the nearest next, then parts reversed as long as that shortens it.
std::vector<std::size_t> short_order(const Chain& chain, const std::vector<PlannedPose>& poses);

/// Where the arm goes first, so that every joint comes to the pose from the side that is wanted.
JointVector approach_stop(const Chain& chain, const PlannedPose& pose);

/// Whether the arm can be measured there and can come to it from the side that is wanted.
bool is_feasible(const FeasibleSpace& space, const PlannedPose& pose);

/// Whether nothing is in the way as all joints move together from one stop to another.
bool is_free(const FeasibleSpace& space, const JointVector& from, const JointVector& to);

/// One stop of the way.
struct WayStop {
  JointVector joints;
  int pose = -1;  ///< which pose is measured here; -1: only passed
};

struct MeasuringWay {
  std::vector<WayStop> stops;
  std::vector<std::size_t> blocked;  ///< poses that no free way was found to from the one before
};

/// The way along `poses` in their order: to each through its approach stop, with other stops between where the straight
/// way is not free.
MeasuringWay way_along(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream random);

}  // namespace demecal::inline planning
