#include "products/tall_products.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "pieces/pieces.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline products {
namespace {

// A tile of the product is summed up in registers, term after term, and a term is rounded twice: so there are the same
// bits with two numbers to a register and with eight, which libraries for this do not promise.
constexpr int kTileRows = 6, kTileColumns = 8;
constexpr Eigen::Index kTile = kTileRows * kTileColumns;
constexpr Eigen::Index kTerms = 256;         ///< summed up at a time, so that what they take stays near the processor
constexpr Eigen::Index kRowsOfPiece = 2048;  ///< the parts of a sum; a multiple of kTerms
constexpr Eigen::Index kRowsOfResult = 96;   ///< a multiple of kTileRows
constexpr Eigen::Index kFew = 3;  ///< columns, for which it takes longer to pack the rest into tiles than to read it

using Packed = std::vector<double>;

/// As many doubles as a register holds; `Anywhere`: the same in memory.
struct TwoNumbers {
  using InRegister = double __attribute__((vector_size(2 * sizeof(double))));
  using Anywhere = double __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));
};
struct FourNumbers {
  using InRegister = double __attribute__((vector_size(4 * sizeof(double))));
  using Anywhere = double __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));
};
struct EightNumbers {
  using InRegister = double __attribute__((vector_size(8 * sizeof(double))));
  using Anywhere = double __attribute__((vector_size(8 * sizeof(double)), aligned(sizeof(double)), may_alias));
};

Eigen::Index tiles_for(Eigen::Index count, Eigen::Index each) {
  return (count + each - 1) / each;
}

/// Adds to a tile the products of `terms` columns of kTileRows numbers with rows of kTileColumns, so many registers of
/// a row at a time that all their sums stay in registers.
template <typename Numbers, int kRegisters>
[[gnu::always_inline]] inline void add_packed_terms(Eigen::Index terms, const double* left, const double* right,
                                                    double* tile) {
  using InRegister = typename Numbers::InRegister;
  using Anywhere = typename Numbers::Anywhere;
  constexpr int kNumbers = sizeof(InRegister) / sizeof(double), kSums = kTileRows * kRegisters;
  for (int first = 0; first < kTileColumns; first += kRegisters * kNumbers) {
    InRegister sums[kSums] = {};
    const double *column = left, *row = right + first;
    for (Eigen::Index term = 0; term < terms; ++term, column += kTileRows, row += kTileColumns) {
      InRegister factors[kRegisters];
      for (int i = 0; i < kRegisters; ++i) factors[i] = *reinterpret_cast<const Anywhere*>(row + i * kNumbers);
#pragma GCC unroll 12
      for (int i = 0; i < kSums; ++i) sums[i] += column[i / kRegisters] * factors[i % kRegisters];
    }
    for (int i = 0; i < kSums; ++i) {
      double* const to = tile + i / kRegisters * kTileColumns + first + i % kRegisters * kNumbers;
      *reinterpret_cast<Anywhere*>(to) += sums[i];
    }
  }
}

#if defined(DEMECAL_VECTOR_UNIT)
DEMECAL_VECTOR_UNIT("arch=x86-64-v4")
void add_to_tile(Eigen::Index terms, const double* left, const double* right, double* tile) {
  add_packed_terms<EightNumbers, 1>(terms, left, right, tile);
}

DEMECAL_VECTOR_UNIT("arch=x86-64-v3")
void add_to_tile(Eigen::Index terms, const double* left, const double* right, double* tile) {
  add_packed_terms<FourNumbers, 2>(terms, left, right, tile);
}

DEMECAL_VECTOR_UNIT("default")
#endif
void add_to_tile(Eigen::Index terms, const double* left, const double* right, double* tile) {
  add_packed_terms<TwoNumbers, 2>(terms, left, right, tile);
}

/// Columns first .. first + width - 1 of the rows, row after row; zeros where there are no such columns.
template <typename Rows>
void pack(const Rows& rows, Eigen::Index first, Eigen::Index width, double* to) {
  const Eigen::Index there = std::clamp<Eigen::Index>(rows.cols() - first, 0, width);
  for (Eigen::Index row = 0; row < rows.rows(); ++row, to += width) {
    for (Eigen::Index i = 0; i < there; ++i) to[i] = rows(row, first + i);
    std::fill(to + there, to + width, 0.0);
  }
}

/// All columns of at most kTerms rows, `width` at a time, each kTerms * width numbers after the last.
template <typename Rows>
void pack_all(const Rows& rows, Eigen::Index width, Packed& to) {
  const Eigen::Index tiles = tiles_for(rows.cols(), width);
  to.resize(static_cast<std::size_t>(tiles * kTerms * width));
  for (Eigen::Index tile = 0; tile < tiles; ++tile) pack(rows, tile * width, width, to.data() + tile * kTerms * width);
}

/// Tiles of a product, column of tiles after column of tiles.
class Tiles {
 public:
  Tiles() = default;
  Tiles(Eigen::Index rows, Eigen::Index columns)
      : down_(tiles_for(rows, kTileRows)),
        across_(tiles_for(columns, kTileColumns)),
        sums_(static_cast<std::size_t>(down_ * across_ * kTile), 0.0) {}

  /// Adds the products of packed terms. `lower`: tiles above the diagonal are left out.
  void add(Eigen::Index terms, const Packed& left, const Packed& right, bool lower) {
    for (Eigen::Index column = 0; column < across_; ++column) {
      for (Eigen::Index row = lower ? column * kTileColumns / kTileRows : 0; row < down_; ++row)
        add_to_tile(terms, left.data() + row * kTerms * kTileRows, right.data() + column * kTerms * kTileColumns,
                    sums_.data() + (column * down_ + row) * kTile);
    }
  }
  void operator+=(const Tiles& other) {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  }
  double operator()(Eigen::Index row, Eigen::Index column) const {
    const Eigen::Index tile = column / kTileColumns * down_ + row / kTileRows;
    return sums_[static_cast<std::size_t>(tile * kTile + row % kTileRows * kTileColumns + column % kTileColumns)];
  }

 private:
  Eigen::Index down_ = 0, across_ = 0;
  std::vector<double> sums_;
};

/// The sum over all rows, in parts of kRowsOfPiece.
template <typename Left>
Tiles summed_products(const Left& left, const RowsOf& right, bool lower) {
  DEMECAL_CHECK(left.rows() == right.rows(), left.rows() << " rows and " << right.rows());
  const Eigen::Index parts = tiles_for(left.rows(), kRowsOfPiece);
  std::vector<Tiles> sums(static_cast<std::size_t>(parts));
  in_pieces(sums.size(), [&](std::size_t part) {
    Tiles sum(left.cols(), right.cols());
    Packed left_terms, right_terms;
    const Eigen::Index begin = static_cast<Eigen::Index>(part) * kRowsOfPiece;
    const Eigen::Index end = std::min(begin + kRowsOfPiece, left.rows());
    for (Eigen::Index row = begin; row < end; row += kTerms) {
      const Eigen::Index terms = std::min(kTerms, end - row);
      pack_all(left.middleRows(row, terms), kTileRows, left_terms);
      pack_all(right.middleRows(row, terms), kTileColumns, right_terms);
      sum.add(terms, left_terms, right_terms, lower);
    }
    sums[part] = std::move(sum);
  });
  Tiles all(left.cols(), right.cols());
  for (const Tiles& sum : sums) all += sum;
  return all;
}

/// A matrix's numbers where they are: terms are to be summed up, one sum a lane.
struct Summands {
  const double* first;
  Eigen::Index lane_stride, term_stride;
};

/// Adds to every lane's sum what its terms come to times the factors: as tiles do it, to the bit.
void add_few_terms(const Summands& summands, const Eigen::Ref<const Eigen::VectorXd>& factors,
                   Eigen::Ref<Eigen::VectorXd> sums) {
  constexpr Eigen::Index kAtOnce = 8;  // additions of one lane wait for one another
  const auto add = [&](Eigen::Index lane, auto count) {
    double sum[kAtOnce] = {};
    const double* from = summands.first + lane * summands.lane_stride;
    for (Eigen::Index term = 0; term < factors.size(); ++term, from += summands.term_stride)
      for (Eigen::Index i = 0; i < count; ++i) sum[i] += from[i * summands.lane_stride] * factors[term];
    for (Eigen::Index i = 0; i < count; ++i) sums[lane + i] += sum[i];
  };
  Eigen::Index lane = 0;
  for (; lane + kAtOnce <= sums.size(); lane += kAtOnce) add(lane, std::integral_constant<Eigen::Index, kAtOnce>{});
  for (; lane < sums.size(); ++lane) add(lane, std::integral_constant<Eigen::Index, 1>{});
}

/// summed_products() of few columns.
template <typename Left>
Eigen::MatrixXd product_of_few(const Left& left, const Eigen::MatrixXd& right) {
  DEMECAL_CHECK(left.rows() == right.rows(), left.rows() << " rows and " << right.rows());
  const Eigen::Index lane_stride = Left::IsRowMajor ? 1 : left.outerStride();
  const Eigen::Index term_stride = Left::IsRowMajor ? left.outerStride() : 1;
  std::vector<Eigen::MatrixXd> sums(static_cast<std::size_t>(tiles_for(left.rows(), kRowsOfPiece)));
  in_pieces(sums.size(), [&](std::size_t part) {
    const Eigen::Index begin = static_cast<Eigen::Index>(part) * kRowsOfPiece;
    const Eigen::Index end = std::min(begin + kRowsOfPiece, left.rows());
    sums[part].setZero(left.cols(), right.cols());
    for (Eigen::Index row = begin; row < end; row += kTerms)
      for (Eigen::Index k = 0; k < right.cols(); ++k)
        add_few_terms({left.data() + row * term_stride, lane_stride, term_stride},
                      right.col(k).segment(row, std::min(kTerms, end - row)), sums[part].col(k));
  });
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(left.cols(), right.cols());
  for (const Eigen::MatrixXd& sum : sums) all += sum;
  return all;
}

template <typename Left>
Eigen::MatrixXd whole_product(const Left& left, const RowsOf& right) {
  if (right.cols() <= kFew) return product_of_few(left, right);
  const Tiles sums = summed_products(left, right, false);
  return Eigen::MatrixXd::NullaryExpr(left.cols(), right.cols(),
                                      [&](Eigen::Index i, Eigen::Index k) { return sums(i, k); });
}

}  // namespace

Eigen::MatrixXd transposed_product(const RowsOf& left, const RowsOf& right) {
  return whole_product(left, right);
}

Eigen::MatrixXd transposed_product_of_columns(const Eigen::Ref<const Eigen::MatrixXd>& left, const RowsOf& right) {
  return whole_product(left, right);
}

Eigen::MatrixXd square_product(const RowsOf& rows) {
  const Tiles sums = summed_products(rows, rows, true);
  return Eigen::MatrixXd::NullaryExpr(
      rows.cols(), rows.cols(), [&](Eigen::Index i, Eigen::Index k) { return sums(std::max(i, k), std::min(i, k)); });
}

RowMatrix product(const RowsOf& left, const Eigen::Ref<const Eigen::MatrixXd>& factors) {
  DEMECAL_CHECK(left.cols() == factors.rows(), left.cols() << " columns for " << factors.rows() << " factors");
  RowMatrix result(left.rows(), factors.cols());
  const auto parts = static_cast<std::size_t>(tiles_for(left.rows(), kRowsOfResult));
  const auto rows_of = [&](std::size_t part) {
    const Eigen::Index first = static_cast<Eigen::Index>(part) * kRowsOfResult;
    return std::pair(first, std::min(kRowsOfResult, left.rows() - first));
  };
  if (factors.cols() <= kFew) {
    in_pieces(parts, [&](std::size_t part) {
      const auto [first, rows] = rows_of(part);
      Eigen::VectorXd sums(rows);
      for (Eigen::Index k = 0; k < factors.cols(); ++k) {
        sums.setZero();
        for (Eigen::Index term = 0; term < left.cols(); term += kTerms)
          add_few_terms({left.data() + first * left.outerStride() + term, left.outerStride(), 1},
                        factors.col(k).segment(term, std::min(kTerms, left.cols() - term)), sums);
        result.col(k).segment(first, rows) = sums;
      }
    });
    return result;
  }
  std::vector<Packed> right;  // kTerms factors each
  for (Eigen::Index term = 0; term < left.cols(); term += kTerms)
    pack_all(factors.middleRows(term, std::min(kTerms, left.cols() - term)), kTileColumns, right.emplace_back());
  in_pieces(parts, [&](std::size_t part) {
    const auto [first, rows] = rows_of(part);
    Tiles sums(rows, factors.cols());
    Packed terms;
    for (std::size_t block = 0; block < right.size(); ++block) {
      const Eigen::Index begin = static_cast<Eigen::Index>(block) * kTerms;
      const Eigen::Index count = std::min(kTerms, left.cols() - begin);
      pack_all(left.block(first, begin, rows, count).transpose(), kTileRows, terms);
      sums.add(count, terms, right[block], false);
    }
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index k = 0; k < factors.cols(); ++k) result(first + i, k) = sums(i, k);
  });
  return result;
}

}  // namespace demecal::inline products
