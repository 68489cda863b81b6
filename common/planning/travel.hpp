// In which order to visit poses, and what is in the way of straight motions.
#pragma once

#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"

namespace demecal::inline planning {

/// How far the joint is that moves most, rad; a metre of a prismatic joint counts as 2 rad.
double travel(const Chain& chain, const JointVector& from, const JointVector& to);

/// Indices of the poses in an order of short travel: the nearest next, then parts reversed as long as that shortens it.
std::vector<std::size_t> short_order(const Chain& chain, const std::vector<PlannedPose>& poses);

/// Where the arm goes first, so that every joint comes to the pose from the side that is wanted.
JointVector approach_stop(const FeasibleSpace& space, const PlannedPose& pose);

/// Whether the arm can be measured there and can come to it from the side that is wanted.
bool is_feasible(const FeasibleSpace& space, const PlannedPose& pose);

/// What the arm meets as all joints move together from one stop to another, both included: it is looked at wherever a
/// part has moved by the radius of the thinnest.
Obstruction on_the_way(const FeasibleSpace& space, const JointVector& from, const JointVector& to);

/// Whether nothing is in the way there.
bool is_free(const FeasibleSpace& space, const JointVector& from, const JointVector& to);

}  // namespace demecal::inline planning
