// The triangular factor of a Jacobian of any length, kept in little memory.
#pragma once

#include <Eigen/Core>

namespace demecal {

/// Takes a Jacobian piece by piece: R (n x n) with R^T R = J^T J, without the loss of half the digits that forming
/// J^T J would cost.
class TriangularFactor {
 public:
  explicit TriangularFactor(int columns);

  /// Adds rows (any number x columns).
  void add(const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& rows);
  /// Upper triangular, columns x columns, of the rows added so far.
  Eigen::MatrixXd factor();

 private:
  void reduce();

  Eigen::MatrixXd stack_;
  Eigen::Index filled_ = 0;
};

}  // namespace demecal
