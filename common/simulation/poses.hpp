// Where a simulated robot is sent: random poses of its tool in a cuboid, or random joints.
#pragma once

#include <vector>

#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"

namespace demecal::inline simulation {

/// Joint values (rad or m) of `count` random poses, all within the robot's limits. By joints: uniform within the
/// ranges. In the cuboid: the nominal tool point is uniform in it and the orientation that of `home`, tilted at random,
/// among those that the arm reaches away from singularities; arms of fewer than 6 joints cannot hold an orientation,
/// and stand at random joints that bring their tool point into the cuboid. Throws InputError where no pose was found in
/// a bounded number of attempts.
std::vector<JointVector> draw_poses(const Scenario& scenario, int count, RandomStream& random);

}  // namespace demecal::inline simulation
