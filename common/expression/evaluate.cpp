#include "expression/evaluate.hpp"

#include <algorithm>

#include "errors/check.hpp"
#include "expression/fold.hpp"

namespace demecal {
namespace {

constexpr std::size_t kRowsOfEvaluation = 256;  // so that the columns of a strip stay in the first-level cache
constexpr std::size_t kStripStride =
    kRowsOfEvaluation + kLanes;  // not a power of two, so that they share no cache sets

}  // namespace

double evaluate(std::span<const Node> tree, std::span<const double> variables) {
  return fold<double>(
      tree,
      [&](const Node& node) { return node.primitive == Primitive::constant ? node.value : variables[node.variable]; },
      [](Primitive function, double argument) { return value_of(function, argument); },
      [](Primitive function, double left, double right) { return value_of(function, left, right); });
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

// The i-th operand of the stack keeps its column in the i-th strip of the scratch memory.
Operand ColumnEvaluator::make_steps(std::span<const Node> tree) {
  steps_.clear();
  Operand* next = operands_.data();
  for (std::size_t i = tree.size(); i-- > 0;) {
    const Node& node = tree[i];
    const int taken = arity(node.primitive);
    if (taken == 0) {
      *next++ = node.primitive == Primitive::constant ? Operand{nullptr, node.value, false}
                                                      : Operand{columns_.column(node.variable), 0.0, true};
      continue;
    }
    if (taken == 2) --next;
    const Operand left = *next;
    Operand& last = *(next - 1);
    double* const out = scratch_.data() + (next - 1 - operands_.data()) * static_cast<std::ptrdiff_t>(kStripStride);
    if (last.column == nullptr && (taken == 1 || left.column == nullptr)) {
      last.constant =
          taken == 1 ? value_of(node.primitive, last.constant) : value_of(node.primitive, left.constant, last.constant);
      continue;
    }
    steps_.push_back(taken == 1 ? step_of(node.primitive, last, out, false)
                                : step_of(node.primitive, left, last, out, false));
    last = {out, 0.0, false};
  }
  return operands_.front();
}

std::span<const double> ColumnEvaluator::padded_values(std::span<const Node> tree) {
  const std::size_t most_leaves = tree.size() / 2 + 1;
  if (operands_.size() < most_leaves) {
    operands_.resize(most_leaves);
    scratch_.resize(most_leaves * kStripStride);
  }
  const Operand value = make_steps(tree);
  for (std::size_t begin = 0; begin < columns_.padded_rows(); begin += kRowsOfEvaluation) {
    const std::size_t rows = std::min(kRowsOfEvaluation, columns_.padded_rows() - begin);
    double* const out = result_.data() + begin;
    run(steps_, begin, rows);
    if (value.column == nullptr) {
      std::fill_n(out, rows, value.constant);
    } else {
      std::copy_n(value.column + (value.whole ? begin : 0), rows, out);
    }
  }
  return result_;
}

}  // namespace demecal
