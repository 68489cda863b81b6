// Poses that the arm could be measured in, drawn at random.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

struct DrawnPoses {
  std::vector<PlannedPose> poses;
  std::size_t drawn = 0;
  std::array<std::size_t, kObstructions> refused{};
};

/// `count` feasible poses, or as many as are found: joints uniform in their ranges and then, where few are feasible,
/// near those found. Every joint comes from a side drawn at random, and the arm can stand on that side of the pose.
DrawnPoses draw_poses(const FeasibleSpace& space, std::size_t count, RandomStream random);

/// How many candidates to choose so many poses from: the time that grows with them, times numbers squared, stays within
/// seconds.
std::size_t candidates_for(const InformationModel& model, std::size_t poses);

/// The effects of these kinds that a measurement from both sides of every joint could show on this arm: of each kind
/// and joint the plainest form that the arm's description allows.
std::vector<Effect> effects_to_detect(const Robot& robot, const std::vector<Interval>& ranges,
                                      const std::vector<std::string>& kinds, bool orientation);

}  // namespace demecal::inline planning
