// Link parameters that vary with the joints, as sums of given functions: the shape of most models of the literature.
#pragma once

#include <functional>

#include "baselines/baseline.hpp"

namespace demecal {

/// One function of the joints, whose coefficient adds to a link parameter (rad or m).
struct LinkFunction {
  int joint = 0;
  LinkParameter parameter = LinkParameter::theta;
  std::function<double(const JointVector&)> value;
};

/// Base, tool where declared, and the coefficients of the functions, fitted together from the registered arm by
/// Gauss-Newton steps. The coefficients are held near zero by a ridge that cross-validation chooses.
struct VaryingFit {
  BaselineFit fit;
  double cost = 0.0;   ///< of the cross-validation
  double ridge = 0.0;  ///< chosen
};
VaryingFit fit_varying_links(const RegisteredArm& arm, const std::vector<LinkFunction>& functions);

}  // namespace demecal
