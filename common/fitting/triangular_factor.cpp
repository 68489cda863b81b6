#include "fitting/triangular_factor.hpp"

#include <Eigen/QR>

namespace demecal {
namespace {

constexpr Eigen::Index kRowsAtOnce = 512;

}  // namespace

TriangularFactor::TriangularFactor(int columns)
    : stack_(Eigen::MatrixXd::Zero(columns + kRowsAtOnce, columns)), filled_(columns) {}

void TriangularFactor::add(
    const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& rows) {
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (filled_ == stack_.rows()) reduce();
    stack_.row(filled_++) = rows.row(i);
  }
}

void TriangularFactor::reduce() {
  const Eigen::Index n = stack_.cols();
  if (n == 0) {
    filled_ = 0;
    return;
  }
  stack_.bottomRows(stack_.rows() - filled_).setZero();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stack_);
  stack_.topRows(n) = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  filled_ = n;
}

Eigen::MatrixXd TriangularFactor::factor() {
  reduce();
  return stack_.topRows(stack_.cols());
}

}  // namespace demecal
