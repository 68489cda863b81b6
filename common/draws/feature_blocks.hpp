// Columns as sums of features (one number a pose) times motions (one number a row), kept by motion.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "products/tall_products.hpp"

namespace demecal::inline draws {

using RowMatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct FeatureBlock {
  Eigen::Index motion = 0;            ///< which column of the motions
  std::vector<Eigen::Index> columns;  ///< which columns the features belong to, ascending
  Eigen::MatrixXd features;           ///< poses x columns
};

/// Every pose's rows along one motion: poses x columns of `rows`. `first_row`: of each pose, and one past the last.
template <typename Rows>
Rows along_motion(const std::vector<Eigen::Index>& first_row, const RowMatrix& motions, Eigen::Index motion,
                  const Rows& rows) {
  using Scalar = typename Rows::Scalar;
  Rows along(static_cast<Eigen::Index>(first_row.size()) - 1, rows.cols());
  for (Eigen::Index pose = 0; pose < along.rows(); ++pose) {
    const auto place = static_cast<std::size_t>(pose);
    auto target = along.row(pose);
    target.setZero();
    for (Eigen::Index row = first_row[place]; row < first_row[place + 1]; ++row)
      target += static_cast<Scalar>(motions(row, motion)) * rows.row(row);
  }
  return along;
}

/// The sum of what each block gives for its columns, of `columns` in all.
template <typename Matrix>
Matrix summed(const std::vector<FeatureBlock>& blocks, const std::vector<Matrix>& parts, Eigen::Index columns,
              Eigen::Index count) {
  Matrix sum = Matrix::Zero(columns, count);
  for (std::size_t block = 0; block < parts.size(); ++block) {
    for (std::size_t i = 0; i < blocks[block].columns.size(); ++i)
      sum.row(blocks[block].columns[i]) += parts[block].row(static_cast<Eigen::Index>(i));
  }
  return sum;
}

/// X^T rows of all `columns` columns X, in single precision.
Eigen::MatrixXf transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrixF& rows);

}  // namespace demecal::inline draws
