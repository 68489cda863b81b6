#include "residuals/projection.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "fitting/row_sums.hpp"
#include "products/tall_products.hpp"

namespace demecal::inline residuals {
namespace {

/// The matrix (n x r) that makes the model's columns over the fitted rows and those of the prior orthonormal, r their
/// rank.
Eigen::MatrixXd orthonormaliser(const ModelColumns& model, const RowMatrix& prior) {
  // Sums of squares are formed in vector registers, reflections are not. They lose twice as many digits, which are to
  // spare where no column is all but a sum of others.
  constexpr double kClearlyNew = 2e-5;
  constexpr double kDependent = 1e-6;  // as the fit: less is determined to metres at best
  const Eigen::Index n = model.precision.size();
  if (n == 0) return Eigen::MatrixXd(0, 0);
  Eigen::MatrixXd squares = square_product(model.fitted);
  if (model.known.rows() > 0) squares += model.known.transpose() * model.known;
  squares.diagonal() += model.precision.cwiseAbs2();
  Eigen::VectorXd scale = squares.diagonal().cwiseSqrt();
  for (double& value : scale) value = value > 0 ? 1 / value : 0.0;
  const Cholesky root(scale.asDiagonal() * squares * scale.asDiagonal());
  if (root.succeeded() && root.lower().diagonal().minCoeff() > kClearlyNew)
    return scale.asDiagonal() * root.whitened(Eigen::MatrixXd::Identity(n, n)).transpose();
  const Eigen::MatrixXd factor = triangular_factor(model.fitted, prior);
  return scale.asDiagonal() * PivotedQr(factor * scale.asDiagonal(), kDependent).to_basis();
}

/// Puts columns after the first `rank` ones, with room for more so that not every addition copies all of them.
void append_columns(RowMatrix& to, Eigen::Index rank, const RowMatrix& columns) {
  constexpr Eigen::Index kRoom = 64;
  if (to.cols() < rank + columns.cols()) to.conservativeResize(Eigen::NoChange, rank + columns.cols() + kRoom);
  to.middleCols(rank, columns.cols()) = columns;
}

}  // namespace

Projection::Projection(const ModelColumns& model, const Eigen::VectorXd& fitted, const Eigen::VectorXd& validation)
    : residual_(fitted),
      validation_residual_(validation),
      prior_residual_(model.known.rows() + model.precision.size()),
      shared_(model.shared) {
  const Eigen::Index columns = model.precision.size(), known = model.known.rows();
  RowMatrix prior(known + columns, columns);
  if (known > 0) prior.topRows(known) = model.known;
  prior.bottomRows(columns) = model.precision.asDiagonal().toDenseMatrix();
  if (known > 0) prior_residual_.head(known) = model.known_residual;
  prior_residual_.tail(columns) = -model.precision.cwiseProduct(model.offset);
  to_basis_ = orthonormaliser(model, prior);
  has_prior_.assign(static_cast<std::size_t>(known), true);
  for (const double precision : model.precision) has_prior_.push_back(precision != 0.0);
  basis_ = product(model.fitted, to_basis_);
  validation_basis_ = product(model.validation, to_basis_);
  prior_basis_ = prior * to_basis_;
  rank_ = basis_.cols();
  freedom_ = static_cast<double>(residual_.size()) - basis_.squaredNorm();
  const Eigen::VectorXd along = transposed_product(basis_, residual_) + prior_basis_.transpose() * prior_residual_;
  changes_ = to_basis_ * along;
  residual_ -= product(basis_, along);
  validation_residual_ -= validation_basis_ * along;
  prior_residual_ -= prior_basis_ * along;
}

Projection::Unexplained Projection::unexplained(const RowMatrix& fitted, const RowMatrix& validation) const {
  const Eigen::MatrixXd along = transposed_product(basis(), fitted);
  return {fitted - product(basis(), along), validation - product(validation_basis(), along), -prior_basis() * along};
}

Projection::Trial Projection::trial(const RowMatrix& fitted, const RowMatrix& validation) const {
  Trial result{unexplained(fitted, validation)};
  Eigen::VectorXd scale = fitted.colwise().norm().transpose();
  for (double& value : scale) value = value > kNoColumn ? 1 / value : 0.0;
  const Eigen::MatrixXd gram = scale.asDiagonal() *
                               (square_product(result.fitted) + result.prior.transpose() * result.prior) *
                               scale.asDiagonal();
  const Eigen::VectorXd moment = scale.cwiseProduct(fitted.transpose() * residual_);
  const auto eigen = eigen_system(gram);
  const Eigen::VectorXd turned = eigen.vectors.transpose() * moment;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(turned.size());
  result.to_basis.resize(turned.size(), turned.size());
  result.along.resize(turned.size());
  for (Eigen::Index i = 0; i < turned.size(); ++i) {
    const double share = eigen.values[i];
    if (share < kNewShare) continue;
    solution[i] = turned[i] / share;
    result.drop += turned[i] * solution[i];
    result.along[result.rank] = turned[i] / std::sqrt(share);
    result.to_basis.col(result.rank++) = scale.cwiseProduct(eigen.vectors.col(i)) / std::sqrt(share);
  }
  result.to_basis.conservativeResize(Eigen::NoChange, result.rank);
  result.along.conservativeResize(result.rank);
  result.coefficients = scale.cwiseProduct(eigen.vectors * solution);
  result.validation_residual = validation_residual_ - result.validation * result.coefficients;
  return result;
}

void Projection::add(const Trial& trial) {
  const RowMatrix fitted = trial.columns(), validation = trial.validation * trial.to_basis;
  const RowMatrix prior = trial.prior * trial.to_basis;
  residual_ -= fitted * trial.along;
  validation_residual_ -= validation * trial.along;
  prior_residual_ -= prior * trial.along;
  append_columns(basis_, rank_, fitted);
  append_columns(validation_basis_, rank_, validation);
  append_columns(prior_basis_, rank_, prior);
  rank_ += fitted.cols();
  freedom_ -= fitted.squaredNorm();
}

}  // namespace demecal::inline residuals
