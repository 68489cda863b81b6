// Sums over a Jacobian of any length in little memory: its products over a basis, and its triangular factor.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "products/tall_products.hpp"

namespace demecal::inline fitting {

/// Takes weighed rows piece by piece and sums them up over a basis B: B^T J^T W J B and B^T J^T W r. Rows are
/// multiplied by the basis before they are squared, so that hardly visible directions keep their digits.
class Information {
 public:
  /// `basis`: parameters x directions; it must outlive this.
  explicit Information(const Eigen::MatrixXd& basis);

  /// Adds rows (any number x parameters) and their residuals, both of one weight.
  template <typename Rows, typename Residuals>
  void add(const Eigen::MatrixBase<Rows>& rows, const Eigen::MatrixBase<Residuals>& residuals, double weight) {
    if (filled_ + rows.rows() > rows_.rows()) make_room(rows.rows());
    const double root = std::sqrt(weight);
    rows_.middleRows(filled_, rows.rows()).noalias() = root * rows;
    residuals_.segment(filled_, rows.rows()) = root * residuals;
    filled_ += rows.rows();
  }

  /// directions x directions, symmetric.
  Eigen::MatrixXd squares();
  /// One number per direction.
  Eigen::VectorXd gradient();

 private:
  void make_room(Eigen::Index rows);
  void reduce();

  const Eigen::MatrixXd& basis_;
  RowMatrix rows_;
  Eigen::VectorXd residuals_;
  RowMatrix seen_;  ///< rows over the basis
  Eigen::Index filled_ = 0;
  Eigen::MatrixXd squares_;
  Eigen::VectorXd gradient_;
};

/// Takes a Jacobian piece by piece: R (n x n) with R^T R = J^T J, without the loss of half the digits that forming
/// J^T J would cost.
class TriangularFactor {
 public:
  explicit TriangularFactor(int columns);

  /// Adds rows (any number x columns).
  void add(const RowsOf& rows);
  /// Upper triangular, columns x columns, of the rows added so far.
  Eigen::MatrixXd factor();

 private:
  void reduce();

  Eigen::MatrixXd stack_;
  Eigen::Index filled_ = 0;
};

/// The same of the first rows and then the others, by several threads where the caller has them.
Eigen::MatrixXd triangular_factor(const RowsOf& first, const RowsOf& others);

}  // namespace demecal::inline fitting
