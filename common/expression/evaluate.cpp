#include "expression/evaluate.hpp"

#include <algorithm>

#include "errors/check.hpp"
#include "expression/fold.hpp"

// The walk is compiled for several vector units, the widest present is taken at run time. All give the same bits, since
// no operation is contracted or reordered. Sanitizers are not ready yet when the program's loader makes the choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define DEMECAL_FOR_EACH_VECTOR_UNIT __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define DEMECAL_FOR_EACH_VECTOR_UNIT
#endif

namespace demecal {
namespace {

constexpr std::size_t kLanes = 8;        // rows are padded to the widest vector there is
constexpr std::size_t kStripRows = 256;  // so that the columns of a strip stay in the first-level cache
constexpr std::size_t kStripStride = kStripRows + kLanes;  // not a power of two, so that they share no cache sets

std::size_t padded(std::size_t rows) {
  return (rows + kLanes - 1) / kLanes * kLanes;
}

// In the loops below `out` may be an argument's own column: every row depends on itself alone, which ivdep states.

template <class Function>
[[gnu::always_inline]] inline void unary(Operand& argument, double* out, std::size_t blocks, Function function) {
  if (argument.column == nullptr) {
    argument.constant = function(argument.constant);
    return;
  }
  const double* const in = argument.column;
#pragma GCC ivdep
  for (std::size_t i = 0; i < blocks * kLanes; ++i) out[i] = function(in[i]);
  argument.column = out;
}

template <class Function>
[[gnu::always_inline]] inline void binary(const Operand& left, Operand& right, double* out, std::size_t blocks,
                                          Function function) {
  const double* const a = left.column;
  const double* const b = right.column;
  const double constant_a = left.constant;
  const double constant_b = right.constant;
  if (a != nullptr && b != nullptr) {
#pragma GCC ivdep
    for (std::size_t i = 0; i < blocks * kLanes; ++i) out[i] = function(a[i], b[i]);
  } else if (a != nullptr) {
#pragma GCC ivdep
    for (std::size_t i = 0; i < blocks * kLanes; ++i) out[i] = function(a[i], constant_b);
  } else if (b != nullptr) {
#pragma GCC ivdep
    for (std::size_t i = 0; i < blocks * kLanes; ++i) out[i] = function(constant_a, b[i]);
  } else {
    right.constant = function(constant_a, constant_b);
    return;
  }
  right.column = out;
}

[[gnu::always_inline]] inline bool all_reducible(const double* angles, std::size_t blocks) {
  std::int64_t beyond = 0;
  for (std::size_t i = 0; i < blocks * kLanes; ++i) beyond |= std::abs(angles[i]) <= kLargestReducedAngle ? 0 : 1;
  return beyond == 0;
}

template <std::uint64_t quarter_turns>
[[gnu::always_inline]] inline void circular(Operand& argument, double* out, std::size_t blocks) {
  if (argument.column != nullptr && all_reducible(argument.column, blocks)) {
    unary(argument, out, blocks, [](double x) { return reduced_sine(x, quarter_turns); });
  } else {
    unary(argument, out, blocks, [](double x) { return quarter_turns == 0 ? sine(x) : cosine(x); });
  }
}

// Leaves the tree's value in operands[0]. `columns` points at the strip's first row; the i-th operand may keep its
// column at scratch + i * kStripStride.
DEMECAL_FOR_EACH_VECTOR_UNIT
void walk(const Node* tree, std::size_t length, const double* columns, std::size_t column_stride, std::size_t blocks,
          Operand* operands, double* scratch) {
  Operand* next = operands;
  for (std::size_t i = length; i-- > 0;) {
    const Node& node = tree[i];
    const int taken = arity(node.primitive);
    if (taken == 0) {
      *next++ = node.primitive == Primitive::constant ? Operand{nullptr, node.value}
                                                      : Operand{columns + node.variable * column_stride, 0.0};
      continue;
    }
    if (taken == 2) --next;
    const Operand& left = *next;
    Operand& last = *(next - 1);
    double* const out = scratch + (next - 1 - operands) * static_cast<std::ptrdiff_t>(kStripStride);
    switch (node.primitive) {
      case Primitive::add:
        binary(left, last, out, blocks, [](double a, double b) { return a + b; });
        break;
      case Primitive::subtract:
        binary(left, last, out, blocks, [](double a, double b) { return a - b; });
        break;
      case Primitive::multiply:
        binary(left, last, out, blocks, [](double a, double b) { return a * b; });
        break;
      case Primitive::divide:
        binary(left, last, out, blocks, protected_divide);
        break;
      case Primitive::sine:
        circular<0>(last, out, blocks);
        break;
      case Primitive::cosine:
        circular<1>(last, out, blocks);
        break;
      case Primitive::sign:
        unary(last, out, blocks, sign_of);
        break;
      case Primitive::square_root:
        unary(last, out, blocks, protected_square_root);
        break;
      default:
        break;
    }
  }
}

}  // namespace

double evaluate(std::span<const Node> tree, std::span<const double> variables) {
  return fold<double>(
      tree,
      [&](const Node& node) { return node.primitive == Primitive::constant ? node.value : variables[node.variable]; },
      [](Primitive function, double argument) { return value_of(function, argument); },
      [](Primitive function, double left, double right) { return value_of(function, left, right); });
}

ColumnEvaluator::ColumnEvaluator(Columns columns)
    : rows_(columns.empty() ? 0 : columns.front().size()), padded_rows_(padded(rows_)), result_(padded_rows_) {
  columns_.reserve(columns.size() * padded_rows_);
  for (const std::vector<double>& column : columns) {
    DEMECAL_CHECK(column.size() == rows_, "rows=" << column.size() << " first column's rows=" << rows_);
    columns_.insert(columns_.end(), column.begin(), column.end());
    if (rows_ > 0) columns_.insert(columns_.end(), padded_rows_ - rows_, column.back());
  }
}

std::span<const double> ColumnEvaluator::operator()(std::span<const Node> tree) {
  const std::size_t most_leaves = tree.size() / 2 + 1;
  if (operands_.size() < most_leaves) {
    operands_.resize(most_leaves);
    scratch_.resize(most_leaves * kStripStride);
  }
  for (std::size_t begin = 0; begin < padded_rows_; begin += kStripRows) {
    const std::size_t rows = std::min(kStripRows, padded_rows_ - begin);
    walk(tree.data(), tree.size(), columns_.data() + begin, padded_rows_, rows / kLanes, operands_.data(),
         scratch_.data());
    const Operand& value = operands_.front();
    double* const out = result_.data() + begin;
    if (value.column == nullptr) {
      std::fill_n(out, rows, value.constant);
    } else {
      std::copy_n(value.column, rows, out);
    }
  }
  return {result_.data(), rows_};
}

}  // namespace demecal
