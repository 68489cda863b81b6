// Columns of equal length that stay where they are while they are lent.
#pragma once

#include <cstddef>
#include <vector>

#include "expression/aligned_column.hpp"

namespace demecal {

/// Lends columns; that given back last is lent next, while caches still hold it.
class ColumnPool {
 public:
  /// Columns of `rows` rows, as many as `most_bytes` hold. Memory is taken as it is needed and kept.
  ColumnPool(std::size_t rows, std::size_t most_bytes);

  /// A column, or null where all are lent.
  double* take();
  void give_back(double* column) { free_.push_back(column); }

  std::size_t available() const { return most_ - made_ + free_.size(); }
  std::size_t most() const { return most_; }
  std::size_t bytes() const { return blocks_.size() * block_ * stride_ * sizeof(double); }

 private:
  std::size_t stride_;
  std::size_t most_;
  std::size_t block_;  ///< columns whose memory is taken at a time
  std::size_t made_ = 0;
  std::vector<AlignedColumn> blocks_;
  std::vector<double*> free_;
};

}  // namespace demecal
