// What is believed of an arm's geometry before any pose is measured: its maker's figures, give or take a little.
#pragma once

#include <Eigen/Core>

#include "fitting/fit.hpp"
#include "fitting/parameter_space.hpp"

namespace demecal {

/// Independent normal beliefs about the parameters of a space, in changes from its reference.
struct Prior {
  Eigen::VectorXd precision;  ///< one over the standard deviation of each, 1/rad or 1/m; 0: nothing is believed of it
  Eigen::VectorXd offset;     ///< the reference's value minus the believed one, rad or m

  /// The rows (offset + change) * precision that least squares adds to those measured.
  Eigen::VectorXd residual(const Eigen::VectorXd& change) const { return precision.cwiseProduct(offset + change); }
};

/// Nothing is believed of `parameters` numbers.
Prior no_prior(int parameters);

/// Links are believed to be `nominal`'s, within options.prior_m and prior_rad; nothing is believed of base and tools.
Prior link_prior(const ParameterSpace& space, const CorrectedRobot& nominal, const FitOptions& options);

}  // namespace demecal
