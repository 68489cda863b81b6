// How one point of an arm moves by every link parameter, for fits of positions that ask for nothing else.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline kinematics {

/// 3 x (5 n): the linear rows of LinkJacobian.
using PointMotions = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxJoints * kLinkParameters>;

/// The flange of an arm and the screws met on the way to it, at one pose: for any number of points.
class PlacedScrews {
 public:
  /// The flange is that of forward(), and the motions are the rows of link_jacobian(), to the bit.
  PlacedScrews(const FixedTurns& turns, const JointVector& q);

  const Eigen::Isometry3d& flange() const { return flange_; }
  /// Of a point given in the base frame.
  PointMotions motions(const Eigen::Vector3d& point) const;

 private:
  int joints_;
  std::array<Screw, kMaxJoints * kLinkParameters> screws_;
  Eigen::Isometry3d flange_;
};

}  // namespace demecal::inline kinematics
