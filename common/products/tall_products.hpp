// Products of matrices of many rows: by several threads where the caller has them, and of the same bits on every
// machine.
#pragma once

#include <Eigen/Core>

namespace demecal::inline products {

/// Matrices whose rows are the measured numbers, pose by pose.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The same, or some of its rows or columns.
using RowsOf = Eigen::Ref<const RowMatrix, 0, Eigen::OuterStride<>>;

/// left^T right, of as many rows: left's columns x right's columns.
Eigen::MatrixXd transposed_product(const RowsOf& left, const RowsOf& right);
/// The same where left is stored column after column.
Eigen::MatrixXd transposed_product_of_columns(const Eigen::Ref<const Eigen::MatrixXd>& left, const RowsOf& right);
/// rows^T rows.
Eigen::MatrixXd square_product(const RowsOf& rows);
/// left factors, where left has as many columns as `factors` has rows.
RowMatrix product(const RowsOf& left, const Eigen::Ref<const Eigen::MatrixXd>& factors);

}  // namespace demecal::inline products
