#include "effects/joint_correction.hpp"

#include <algorithm>
#include <utility>

#include "expression/evaluate.hpp"
#include "expression/simplify.hpp"

namespace demecal {

JointCorrection::JointCorrection(Tree formula, AngleBranch branch, Interval range_rad)
    : formula_(std::move(formula)),
      derivative_(derivative(formula_, 0)),
      branch_(branch),
      range_rad_(range_rad),
      neutral_(formula_ == neutral_tree()) {}

double JointCorrection::operator()(double theta_rad) const {
  if (neutral_) return 0.0;
  const double inside = std::clamp(branch_(theta_rad), range_rad_.lower, range_rad_.upper);
  return evaluate(formula_, {&inside, 1});
}

double JointCorrection::slope(double theta_rad) const {
  const double theta = branch_(theta_rad);
  if (neutral_ || theta < range_rad_.lower || theta > range_rad_.upper) return 0.0;
  return evaluate(derivative_, {&theta, 1});
}

}  // namespace demecal
