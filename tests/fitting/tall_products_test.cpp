// Products of matrices of many rows: one order of the terms on every machine and for any pieces.
#include "products/tall_products.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "pieces/pieces.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

RowMatrix drawn(Eigen::Index rows, Eigen::Index columns, RandomStream& random) {
  return RowMatrix::NullaryExpr(rows, columns, [&](Eigen::Index, Eigen::Index) { return random.normal(); });
}

/// One element of left^T right, its terms added in the order that every machine keeps to: 256 at a time, 2048 to a
/// part.
double summed(const RowMatrix& left, Eigen::Index i, const RowMatrix& right, Eigen::Index k) {
  double all = 0.0;
  for (Eigen::Index part = 0; part < left.rows(); part += 2048) {
    double sum_of_part = 0.0;
    for (Eigen::Index block = part; block < std::min(part + 2048, left.rows()); block += 256) {
      double sum = 0.0;
      for (Eigen::Index row = block; row < std::min({block + 256, part + 2048, left.rows()}); ++row)
        sum += left(row, i) * right(row, k);
      sum_of_part += sum;
    }
    all += sum_of_part;
  }
  return all;
}

Eigen::MatrixXd summed(const RowMatrix& left, const RowMatrix& right) {
  return Eigen::MatrixXd::NullaryExpr(left.cols(), right.cols(),
                                      [&](Eigen::Index i, Eigen::Index k) { return summed(left, i, right, k); });
}

/// The last piece first.
class Backwards : public PieceRunner {
 public:
  void run(std::size_t count, const Piece& piece) override {
    while (count-- > 0) piece(count);
  }
};

TEST(TallProducts, AreSummedInOneOrderOnEveryMachine) {
  RandomStream random{1};
  for (const Eigen::Index rows : {0, 1, 255, 256, 257, 2047, 2049, 5000}) {
    for (const Eigen::Index columns : {1, 6, 7, 13}) {
      const RowMatrix left = drawn(rows, columns, random);
      for (const Eigen::Index others : {Eigen::Index{2}, columns + 2}) {
        const RowMatrix right = drawn(rows, others, random);
        EXPECT_EQ(transposed_product(left, right), summed(left, right)) << rows << " x " << columns;
        EXPECT_EQ(transposed_product_of_columns(left, right), summed(left, right)) << rows << " x " << columns;
      }
      EXPECT_EQ(square_product(left), summed(left, left)) << rows << " x " << columns;
    }
  }
}

TEST(TallProducts, OfRowsAndFactorsAreSummedOverTheFactorsInOneOrder) {
  RandomStream random{2};
  for (const Eigen::Index columns : {1, 5, 256, 300}) {
    const RowMatrix left = drawn(205, columns, random);
    for (const Eigen::Index others : {2, 9}) {
      const Eigen::MatrixXd factors = drawn(columns, others, random);
      EXPECT_EQ(product(left, factors), RowMatrix(summed(left.transpose(), factors))) << columns;
    }
  }
}

TEST(TallProducts, AreTheSameInWhateverOrderThePiecesAreDone) {
  RandomStream random{3};
  const RowMatrix left = drawn(7000, 11, random), right = drawn(7000, 5, random);
  const Eigen::MatrixXd factors = drawn(11, 3, random);
  const Eigen::MatrixXd across = transposed_product(left, right), square = square_product(left);
  const RowMatrix along = product(left, factors);
  Backwards backwards;
  const RunPiecesBy by(backwards);
  EXPECT_EQ(transposed_product(left, right), across);
  EXPECT_EQ(square_product(left), square);
  EXPECT_EQ(product(left, factors), along);
}

TEST(TallProducts, TakeSomeRowsAndColumnsOfAMatrix) {
  RandomStream random{4};
  const RowMatrix whole = drawn(50, 12, random);
  const RowMatrix some = whole.block(7, 2, 30, 5);
  EXPECT_EQ(square_product(whole.block(7, 2, 30, 5)), square_product(some));
  EXPECT_EQ(product(whole.block(7, 2, 30, 5), Eigen::MatrixXd::Identity(5, 5)), some);
}

}  // namespace
}  // namespace demecal
