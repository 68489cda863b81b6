// Columns of rows for vector units: their memory, and what one function at a time does to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "primitives/primitive.hpp"

namespace demecal::inline primitives {

/// Columns start at a cache line, so that no vector of rows straddles two.
template <class T>
struct LineAligned {
  using value_type = T;
  static constexpr std::size_t kBytes = 64;
  static constexpr std::align_val_t kLine{kBytes};
  LineAligned() = default;
  template <class U>
  explicit LineAligned(const LineAligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }
  bool operator==(const LineAligned&) const = default;
};
using AlignedColumn = std::vector<double, LineAligned<double>>;

inline constexpr std::size_t kLanes = 8;  ///< rows are padded to the widest vector there is

/// `rows` rounded up to whole vectors.
constexpr std::size_t padded(std::size_t rows) {
  return (rows + kLanes - 1) / kLanes * kLanes;
}

/// Columns of equal length, one per variable.
using Columns = std::span<const std::vector<double>>;

/// A copy of columns, each padded to whole vectors of rows by its last row.
class PaddedColumns {
 public:
  explicit PaddedColumns(Columns columns);

  std::size_t rows() const { return rows_; }
  std::size_t padded_rows() const { return padded_rows_; }
  const double* column(std::size_t variable) const { return values_.data() + variable * padded_rows_; }

 private:
  std::size_t rows_;
  std::size_t padded_rows_;
  AlignedColumn values_;  ///< the columns one after the other
};

/// Lends columns; that given back last is lent next, while caches still hold it.
class ColumnPool {
 public:
  /// Columns of `rows` rows, as many as `most_bytes` hold. Memory is taken as it is needed and kept.
  ColumnPool(std::size_t rows, std::size_t most_bytes);

  /// A column, or null where all are lent.
  double* take();
  void release(double* column) { free_.push_back(column); }

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

/// What a function takes in every row: a column, or where that is null, a constant. The column is that of a strip of
/// rows at a time, or the whole one, whose strip begins further on for later rows.
struct Operand {
  const double* column = nullptr;
  double constant = 0.0;
  bool whole = false;
};

/// A function of columns, ready to run.
struct ColumnStep {
  const double* left = nullptr;   ///< the one argument, or the column among the two
  const double* right = nullptr;  ///< the second where both are columns
  double* out = nullptr;
  double constant = 0.0;  ///< the argument that is no column
  std::uint8_t code = 0;  ///< which kernel
  bool left_whole = false, right_whole = false, out_whole = false;
};

/// A function of one column.
ColumnStep make_step(Primitive function, const Operand& argument, double* out, bool out_whole);
/// A function of two arguments, of which one at least is a column.
ColumnStep make_step(Primitive function, const Operand& left, const Operand& right, double* out, bool out_whole);

/// Runs the steps in turn over `rows` rows, a multiple of kLanes, from row `begin` of the whole columns. The bits of
/// every row are those that value_of() gives. A step's `out` may be one of its arguments.
void run(std::span<const ColumnStep> steps, std::size_t begin, std::size_t rows);

}  // namespace demecal::inline primitives
