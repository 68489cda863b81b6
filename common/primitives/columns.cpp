#include "primitives/columns.hpp"

#include <algorithm>

#include "errors/check.hpp"

namespace demecal::inline primitives {
namespace {

constexpr std::size_t kLine = LineAligned<double>::kBytes / sizeof(double);
constexpr std::size_t kPage = 512;  // columns that begin at the same place of their pages share cache sets

std::size_t stride_of(std::size_t rows) {
  const std::size_t lines = (rows + kLine - 1) / kLine * kLine;
  return lines % kPage == 0 ? lines + kLine : lines;
}

constexpr std::size_t kBlockBytes = 32 * 1024;

}  // namespace

ColumnPool::ColumnPool(std::size_t rows, std::size_t most_bytes)
    : stride_(stride_of(rows)),
      most_(most_bytes / (stride_ * sizeof(double))),
      block_(std::clamp<std::size_t>(kBlockBytes / (stride_ * sizeof(double)), 1, std::max<std::size_t>(most_, 1))) {}

double* ColumnPool::take() {
  if (!free_.empty()) {
    double* const column = free_.back();
    free_.pop_back();
    return column;
  }
  if (made_ == most_) return nullptr;
  if (made_ == blocks_.size() * block_) blocks_.emplace_back(block_ * stride_);
  return blocks_.back().data() + made_++ % block_ * stride_;
}

PaddedColumns::PaddedColumns(Columns columns)
    : rows_(columns.empty() ? 0 : columns.front().size()), padded_rows_(padded(rows_)) {
  values_.reserve(columns.size() * padded_rows_);
  for (const std::vector<double>& column : columns) {
    DEMECAL_CHECK(column.size() == rows_, "rows=" << column.size() << " first column's rows=" << rows_);
    values_.insert(values_.end(), column.begin(), column.end());
    if (rows_ > 0) values_.insert(values_.end(), padded_rows_ - rows_, column.back());
  }
}

}  // namespace demecal::inline primitives
