// Products of all candidates' columns with given ones: what a scan scores candidates by.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shared_work/feature_blocks.hpp"
#include "shared_work/shared_work.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

/// X^T Y for columns X that are kept as blocks: a piece is a block's features^T (its motion^T Y).
class CandidateProducts final : public SharedWork {
 public:
  /// Keeps all by reference. `first_row`: of each pose, and one past the last; `motions` and `rows` over these rows.
  CandidateProducts(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                    const RowMatrix& motions, const RowMatrix& rows)
      : blocks_(blocks), first_row_(first_row), motions_(motions), rows_(rows) {}
  static std::unique_ptr<SharedWork> read(WorkReader& reader);

  std::size_t pieces() const override { return blocks_.size(); }
  std::uint32_t numbers_of_piece(std::size_t number) const override;
  /// Columns of the block x columns of `rows`.
  std::vector<double> piece(std::size_t number) const override;
  WorkInputs inputs() const override;

 private:
  const std::vector<FeatureBlock>& blocks_;
  const std::vector<Eigen::Index>& first_row_;
  const RowMatrix& motions_;
  const RowMatrix& rows_;
};

/// X^T Y of all `columns` columns X.
Eigen::MatrixXd transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrix& rows,
                                 const DoWork& do_work);

}  // namespace demecal::inline shared_work
