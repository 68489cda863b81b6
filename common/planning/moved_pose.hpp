// A pose near another one, or with one joint anywhere: what searches among all poses of a space try.
#pragma once

#include <optional>
#include <vector>

#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// `pose` moved at random within the joints' ranges, feasible or not: all joints by normal draws of `width` of their
/// ranges, or a single joint to anywhere; now and then coming from other sides. A pose at one of `sockets` stays there;
/// nothing where the arm does not reach it.
std::optional<PlannedPose> moved_pose(const FeasibleSpace& space, const std::vector<PlannedSocket>& sockets,
                                      const PlannedPose& pose, double width, RandomStream& random);

}  // namespace demecal::inline planning
