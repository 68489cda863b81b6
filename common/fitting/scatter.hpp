// How far the residuals of a fit scatter, per kind of row, and which poses lie farther out than that allows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/least_squares.hpp"

namespace demecal::inline fitting {

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

/// The deviation per kind from the median alone, nothing fitted: a first scale.
RowScales median_deviations(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations);

}  // namespace demecal::inline fitting
