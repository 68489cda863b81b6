// A joint's evolved correction g(theta): h(theta) = theta + g(theta) is where the joint really goes (thesis eq. 4.1).
#pragma once

#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/angles.hpp"

namespace demecal {

/// The correction of one joint. Outside its calibrated range it keeps the value it has at the nearer end, so that it
/// never extrapolates. Of a prismatic joint theta, g and the range are in m, and the branch does not wrap.
class JointCorrection {
 public:
  JointCorrection() = default;  ///< neutral: corrects nothing, anywhere
  /// `formula` of the one variable theta, taken on `branch` and then within `range_rad` (lower <= upper).
  JointCorrection(Tree formula, AngleBranch branch, Interval range_rad);

  /// g at a commanded angle, rad.
  double operator()(double theta_rad) const;
  /// dg / dtheta, rad per rad; 0 outside the range.
  double slope(double theta_rad) const;

  bool is_neutral() const { return neutral_; }
  const Tree& formula() const { return formula_; }
  const AngleBranch& branch() const { return branch_; }
  const Interval& range_rad() const { return range_rad_; }

 private:
  Tree formula_ = neutral_tree();
  Tree derivative_ = constant_tree(0.0);
  AngleBranch branch_;
  Interval range_rad_;
  bool neutral_ = true;
};

}  // namespace demecal
