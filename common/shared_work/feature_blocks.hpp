// Columns as sums of features (one number a pose) times motions (one number a row), kept by motion.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "products/tall_products.hpp"
#include "shared_work/shared_work.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

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
template <typename Matrix, typename Part>
Matrix summed(const std::vector<FeatureBlock>& blocks, const std::vector<Part>& parts, Eigen::Index columns,
              Eigen::Index count) {
  Matrix sum = Matrix::Zero(columns, count);
  for (std::size_t block = 0; block < parts.size(); ++block) {
    for (std::size_t i = 0; i < blocks[block].columns.size(); ++i)
      sum.row(blocks[block].columns[i]) += parts[block].row(static_cast<Eigen::Index>(i));
  }
  return sum;
}

/// Of each block a list (its columns) and two tables (its motion, its features).
void append(const std::vector<FeatureBlock>& blocks, const RowMatrix& motions, WorkInputs& inputs);

/// With those motions alone that the blocks are of.
struct ReceivedBlocks {
  std::vector<FeatureBlock> blocks;
  RowMatrix motions;
};
/// All lists and tables that are left.
ReceivedBlocks read_blocks(WorkReader& reader, std::size_t columns, const std::vector<Eigen::Index>& first_row);

/// X^T rows of all `columns` columns X, in single precision.
Eigen::MatrixXf transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrixF& rows);

}  // namespace demecal::inline shared_work
