// A simulated robot that touches points in place of being measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal::inline simulation {

/// Which of scenario.touched a pose of that set touches, the pose-th of its set: each in turn, those for acceptance by
/// accept poses alone.
const TouchedPoint& touched_by(const Scenario& scenario, PoseSet set, std::size_t pose);

/// The visit, near `start` as it comes from `from`, at which the real arm's tool stands at `point`, within the play
/// drawn from `random`: what a robot that is led there by hand reads. Starts anew at other drawn poses where the arm
/// cannot stand there within its limits. Throws InputError where it never can.
Visit touching_visit(const Scenario& scenario, const SimulatedRobot& robot, const TouchedPoint& point, Visit start,
                     const JointVector& from, RandomStream& random);

/// The signs of a move's joints: 0 below what leaves a gear where it was.
ApproachSigns signs_of_move(const JointVector& from, const JointVector& to);

}  // namespace demecal::inline simulation
