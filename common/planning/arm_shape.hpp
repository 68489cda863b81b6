// How much room an arm takes: capsules about the lines from joint to joint, and how far bodies are from each other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal::inline planning {

/// All points within `radius_m` of a line from one point to another.
struct Capsule {
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

/// The smallest distance between two straight lines of finite length, m; either may be a point.
double segment_distance(const Eigen::Vector3d& from1, const Eigen::Vector3d& to1, const Eigen::Vector3d& from2,
                        const Eigen::Vector3d& to2);

/// How far the surfaces of two capsules are apart, m; below 0 where they meet.
double clearance(const Capsule& one, const Capsule& other);

/// A part of the arm: the line along one of a link's offsets, or from the flange to the tool point.
struct ArmPart {
  int link = 0;          ///< whose offset it is, from 0; the number of joints: the tool
  double begin_m = 0.0;  ///< where it begins and ends along the arm, from the base
  double end_m = 0.0;
  Capsule body;
};

/// The parts from the base on, at joint values `q`. `radii_m`: of every link and, last, the tool.
std::vector<ArmPart> arm_parts(const Chain& chain, const JointVector& q, const std::vector<double>& radii_m);

/// Whether two parts of an arm meet. Parts that are near each other along the arm always do, or can never: they do not
/// count.
bool parts_meet(const ArmPart& one, const ArmPart& other);

/// The sum of all lengths that links may have, m.
double reach_m(const Chain& chain);

/// What is assumed of an arm whose thickness nobody states: so much of its reach.
std::vector<double> assumed_radii(const Chain& chain);

}  // namespace demecal::inline planning
