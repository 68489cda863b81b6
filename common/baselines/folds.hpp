// Cross-validation within calibration poses: what is chosen is chosen on poses that were not fitted.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "data/data_set.hpp"

namespace demecal {

/// For each of the poses, the fold (from 0) in which it is left out: repeats of a pose together, the folds in turn.
std::vector<int> folds_of(const DataSet& data, std::span<const std::size_t> poses, int folds);

/// Sums over rows of a linear problem residual = jacobian * change: J^T J, J^T r, r^T r.
struct NormalSums {
  Eigen::MatrixXd square;
  Eigen::MatrixXd linear;  ///< a column for each column of residuals
  double residual = 0.0;

  NormalSums(Eigen::Index parameters, Eigen::Index columns);
  void add(const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Ref<const Eigen::MatrixXd>& residuals);
  void add(const NormalSums& other);
  NormalSums without(const NormalSums& part) const;
  /// The sum of squares that `change` leaves of these rows.
  double left_by(const Eigen::MatrixXd& change) const;
};

/// Sums of rows that come a few at a time, taken in many at once.
class RowSums {
 public:
  RowSums(Eigen::Index parameters, Eigen::Index columns);
  void add(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& residuals);
  /// The sums of all rows so far.
  const NormalSums& sums();

 private:
  NormalSums sums_;
  Eigen::MatrixXd jacobian_, residuals_;
  Eigen::Index waiting_ = 0;
};

/// The change with the least sum of squares plus ridge * weight_k * (J^T J)_kk * (offset_k + change_k)^2, so that the
/// units of a parameter do not matter; parameters without any effect stay as they are. `offset` is parameters x
/// columns.
Eigen::MatrixXd ridge_solution(const NormalSums& sums, const Eigen::VectorXd& weight, double ridge,
                               const Eigen::MatrixXd& offset);

/// Ridges that cross-validation chooses from, ascending.
std::span<const double> ridges();

/// The sums of all parts.
NormalSums total(const std::vector<NormalSums>& parts);

/// How well a ridge does on poses left out.
struct RidgeChoice {
  double ridge = 0.0;
  double cost = 0.0;  ///< sum of squares over all folds' left-out rows
};
RidgeChoice choose_ridge(const std::vector<NormalSums>& by_fold, const Eigen::VectorXd& weight);

}  // namespace demecal
