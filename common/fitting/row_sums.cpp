#include "fitting/row_sums.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "pieces/pieces.hpp"

namespace demecal::inline fitting {
namespace {

constexpr Eigen::Index kProductRows = 256, kFactorRows = 1024;  // collected before they are reduced

}  // namespace

Information::Information(const Eigen::MatrixXd& basis)
    : basis_(basis),
      rows_(kProductRows, basis.rows()),
      residuals_(kProductRows),
      squares_(Eigen::MatrixXd::Zero(basis.cols(), basis.cols())),
      gradient_(Eigen::VectorXd::Zero(basis.cols())) {}

void Information::make_room(Eigen::Index rows) {
  reduce();
  if (rows <= rows_.rows()) return;
  rows_.resize(rows, basis_.rows());
  residuals_.resize(rows);
}

void Information::reduce() {
  if (filled_ == 0) return;
  if (basis_.cols() == 0) {  // products without numbers have no place in memory
    filled_ = 0;
    return;
  }
  seen_ = product(rows_.topRows(filled_), basis_);
  squares_ += square_product(seen_);
  gradient_.noalias() += seen_.transpose() * residuals_.head(filled_);
  filled_ = 0;
}

Eigen::MatrixXd Information::squares() {
  reduce();
  return squares_;
}

Eigen::VectorXd Information::gradient() {
  reduce();
  return gradient_;
}

TriangularFactor::TriangularFactor(int columns) : stack_(Eigen::MatrixXd::Zero(columns + kFactorRows, columns)) {}

void TriangularFactor::add(const RowsOf& rows) {
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
  if (filled_ < n) stack_.middleRows(filled_, n - filled_).setZero();
  stack_.topRows(n) = upper_factor(stack_.topRows(std::max(n, filled_)));
  filled_ = n;
}

Eigen::MatrixXd TriangularFactor::factor() {
  reduce();
  return stack_.topRows(stack_.cols());
}

Eigen::MatrixXd triangular_factor(const RowsOf& first, const RowsOf& others) {
  constexpr Eigen::Index kRowsOfPart = 4096;
  const auto parts = static_cast<std::size_t>((first.rows() + kRowsOfPart - 1) / kRowsOfPart);
  const auto columns = static_cast<int>(first.cols());
  std::vector<TriangularFactor> factors(std::max<std::size_t>(parts, 1), TriangularFactor(columns));
  in_pieces(parts, [&](std::size_t part) {
    const Eigen::Index begin = static_cast<Eigen::Index>(part) * kRowsOfPart;
    factors[part].add(first.middleRows(begin, std::min(kRowsOfPart, first.rows() - begin)));
    if (part > 0) factors[part].factor();
  });
  for (std::size_t part = 1; part < parts; ++part) factors.front().add(factors[part].factor());
  factors.front().add(others);
  return factors.front().factor();
}

}  // namespace demecal::inline fitting
