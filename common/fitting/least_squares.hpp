// Minimises the scaled residuals of many poses over a subspace of the parameters (Levenberg-Marquardt), with what is
// believed of them beforehand.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/observation.hpp"
#include "fitting/parameter_space.hpp"

namespace demecal::inline fitting {

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

/// A sum of squares of the rows in use, and how far to go in lowering it.
struct LeastSquares {
  const DataSet& data;
  const ParameterSpace& space;
  const std::vector<Observation>& observations;
  RowScales scales;
  Eigen::MatrixXd basis;  ///< n x r: changes are start + basis * z
  Prior prior;
  bool robust;  ///< Huber's loss of each pose's norm
  int max_iterations;
};

struct Minimum {
  Eigen::VectorXd change;  ///< of the parameters, n
  double cost = 0.0;       ///< half the sum of squares (of Huber's losses where robust), in scales
  bool converged = false;
};

/// From the change `start` to the nearest minimum: Newton's steps, damped where they fail (Marquardt, 1963), with the
/// exact curvature of Huber's loss, so that they converge fast however many poses lie far out. Converged: another step
/// would lower the cost by less than 1e-12 of one plus itself. The same bits on every run.
Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start);

/// The norm above which Huber's loss grows linearly, of a pose with `rows` rows of unit variance: clean data exceed it
/// once in twenty poses.
double huber_threshold(int rows);

/// The root of the chi-squared quantile with `rows` degrees of freedom at which a normal variable has `normal_quantile`
/// (Wilson and Hilferty, 1931).
double norm_quantile(int rows, double normal_quantile);

}  // namespace demecal::inline fitting
