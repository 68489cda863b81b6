// The columns of many candidate effects over the poses, kept as features on the motions they share.
#pragma once

#include <map>
#include <vector>

#include "effects/effect.hpp"
#include "residuals/residual_field.hpp"

namespace demecal {

using RowMatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Columns first .. first + count - 1 belong to one effect.
struct ColumnSpan {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// A column is a sum of features (one number a pose) times motions of the field (one row a measured number). Features
/// depend on the nominal arm alone: they serve every field over the same poses.
class EffectColumns {
 public:
  /// Columns of one effect after another at `states` (one a pose; equally many in every call).
  void append(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);
  /// Makes the appended columns ready for use.
  void pack();

  Eigen::Index size() const { return columns_; }
  const std::vector<ColumnSpan>& spans() const { return spans_; }

  /// X^T Y (size() x Y's columns) of all columns X over the field's rows and a matrix over the same rows.
  Eigen::MatrixXd transposed_times(const ResidualField& field, const RowMatrix& rows) const;
  /// The same in single precision, which is enough for a null distribution and twice as fast.
  Eigen::MatrixXf transposed_times(const ResidualField& field, const RowMatrixF& rows) const;
  /// The columns of one effect over the field's rows.
  RowMatrix dense(const ResidualField& field, std::size_t effect) const;

 private:
  struct Block {
    Eigen::Index motion = 0;            ///< column of ResidualField::motions
    std::vector<Eigen::Index> columns;  ///< which columns the features belong to, ascending
    Eigen::MatrixXd features;           ///< poses x columns
  };

  std::vector<Block> blocks_;
  std::map<Eigen::Index, std::map<Eigen::Index, Eigen::VectorXd>> loose_;  ///< motion -> column -> features
  std::vector<ColumnSpan> spans_;
  Eigen::Index columns_ = 0;
};

}  // namespace demecal
