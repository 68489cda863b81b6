// Minimises the scaled residuals of many poses over a subspace of the parameters (Levenberg-Marquardt), with what is
// believed of them beforehand; how far the residuals then scatter, and which poses lie farther out than that allows.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"

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

struct Scatter {
  RowScales deviation{};         ///< standard deviation per kind, sqrt(2 cost / dof); 0 for kinds not in use
  RowScales median_deviation{};  ///< the same from the median of absolute residuals, which outliers cannot move
  Eigen::MatrixXd
      covariance;  ///< of z, r x r: the pseudo-inverse of the information in rows over `deviation`, and prior
  std::vector<std::size_t> outliers;  ///< poses (in the data set), ascending
};

/// The scatter at `change` of the problem's rows. Every kind has the degrees of freedom that are left after those the
/// parameters took from it (the leverages of its rows: Foerstner's estimator of variance components, 1979). Where the
/// problem is robust, poses count by their Huber weights. Deviations are at least 1e-9 m or rad, so that exact data do
/// not divide by zero. Outliers are poses that clean data would have once in a hundred fits.
Scatter scatter_at(const LeastSquares& problem, const Eigen::VectorXd& change);

/// The deviation per kind from the median alone, nothing fitted: a first scale; of rows over what `stations` says that
/// their station's are larger by, and with it.
RowScales median_deviations(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations,
                            const std::vector<StationFactors>& stations = {});

}  // namespace demecal::inline fitting
