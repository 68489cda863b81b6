// Where the joints are sent, in the order of measuring.
#pragma once

#include <array>
#include <vector>

#include "kinematics/chain.hpp"
#include "noise_case.hpp"
#include "random/random_stream.hpp"

namespace demecal::bench {

using JointRanges = std::vector<std::array<double, 2>>;  ///< of every joint, rad or m

/// `poses` places within the ranges. Random: uniform and independent. Path: from one uniformly random place to the
/// next in 5 poses, without a corner. Grid: the first joints to and fro over a regular grid in order, the wrist's at
/// one of 7 levels at random.
std::vector<JointVector> joint_course(Course course, const JointRanges& ranges, std::size_t poses,
                                      RandomStream& random);

}  // namespace demecal::bench
