// What gears and elasticity of an arm may do to its tool point, as columns beside those of base, tools and links.
#pragma once

#include <Eigen/Core>

#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

inline constexpr double kJointSideDeviation = 1e-3;  ///< rad or m: how much of each column an arm may have

/// Every joint's own turn by a share of its angle, in periods of one and two to a turn, and by gravity's moment of a
/// mass at the tool and one at the wrist; every axis' tilts once to a turn and by gravity's moment of a mass at the
/// tool. A sliding joint's way by a share of it.
class JointSide {
 public:
  /// Of the arm of `fit`; both must outlive this. `gravity`: base frame.
  JointSide(const Trial& trial, const TrialFit& fit, const Eigen::Vector3d& gravity);

  /// Three rows, instrument's frame.
  Eigen::MatrixXd columns(const TrialRow& row) const;

 private:
  const TrialFit& fit_;
  Eigen::Vector3d down_;
  Eigen::VectorXd largest_;
  double reach_m_ = 1.0;
};

}  // namespace demecal::inline trials
