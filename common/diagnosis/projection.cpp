#include "diagnosis/projection.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "fitting/row_sums.hpp"

namespace demecal {
namespace {

/// The matrix (n x r) that makes columns with the triangular factor `factor` orthonormal, r their rank.
Eigen::MatrixXd orthonormaliser(const Eigen::MatrixXd& factor) {
  constexpr double kDependent = 1e-9;
  const Eigen::Index n = factor.cols();
  if (n == 0) return Eigen::MatrixXd(0, 0);
  Eigen::VectorXd scale = factor.colwise().norm().transpose();
  for (double& value : scale) value = value > 0 ? 1 / value : 0.0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted(factor * scale.asDiagonal());
  pivoted.setThreshold(kDependent);
  const Eigen::Index rank = pivoted.rank();
  const Eigen::MatrixXd inverse = pivoted.matrixR()
                                      .topLeftCorner(rank, rank)
                                      .triangularView<Eigen::Upper>()
                                      .solve(Eigen::MatrixXd::Identity(rank, rank));
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(n, rank);
  padded.topRows(rank) = inverse;
  return scale.asDiagonal() * (pivoted.colsPermutation() * padded);
}

void append(RowMatrix& to, const RowMatrix& columns) {
  to.conservativeResize(Eigen::NoChange, to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

}  // namespace

Projection::Projection(const ModelColumns& model, const Eigen::VectorXd& fitted, const Eigen::VectorXd& judging)
    : left_(fitted),
      judging_left_(judging),
      beliefs_left_(-model.precision.cwiseProduct(model.offset)),
      shared_(model.shared) {
  TriangularFactor factor(static_cast<int>(model.fitted.cols()));
  factor.add(model.fitted);
  const RowMatrix beliefs = model.precision.asDiagonal().toDenseMatrix();
  factor.add(beliefs);
  to_basis_ = orthonormaliser(factor.factor());
  for (const double precision : model.precision) believed_.push_back(precision != 0.0);
  basis_ = model.fitted * to_basis_;
  judging_basis_ = model.judging * to_basis_;
  beliefs_basis_ = beliefs * to_basis_;
  const Eigen::VectorXd along = basis_.transpose() * left_ + beliefs_basis_.transpose() * beliefs_left_;
  changes_ = to_basis_ * along;
  left_ -= basis_ * along;
  judging_left_ -= judging_basis_ * along;
  beliefs_left_ -= beliefs_basis_ * along;
}

double Projection::freedom() const {
  return static_cast<double>(left_.size()) - basis_.squaredNorm();
}

Projection::Trial Projection::trial(const RowMatrix& fitted, const RowMatrix& judging) const {
  Trial result;
  const Eigen::MatrixXd along = basis_.transpose() * fitted;
  result.fitted = fitted - basis_ * along;
  result.judging = judging - judging_basis_ * along;
  result.beliefs = -beliefs_basis_ * along;
  Eigen::VectorXd scale = fitted.colwise().norm().transpose();
  for (double& value : scale) value = value > kNoColumn ? 1 / value : 0.0;
  const Eigen::MatrixXd gram =
      scale.asDiagonal() * (fitted.transpose() * fitted - along.transpose() * along) * scale.asDiagonal();
  const Eigen::VectorXd moment = scale.cwiseProduct(fitted.transpose() * left_);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const Eigen::VectorXd turned = eigen.eigenvectors().transpose() * moment;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(turned.size());
  result.to_basis.resize(turned.size(), turned.size());
  for (Eigen::Index i = 0; i < turned.size(); ++i) {
    const double share = eigen.eigenvalues()[i];
    if (share < kNewShare) continue;
    solution[i] = turned[i] / share;
    result.drop += turned[i] * solution[i];
    result.to_basis.col(result.rank++) = scale.cwiseProduct(eigen.eigenvectors().col(i)) / std::sqrt(share);
  }
  result.to_basis.conservativeResize(Eigen::NoChange, result.rank);
  result.coefficients = scale.cwiseProduct(eigen.eigenvectors() * solution);
  result.judging_left = judging_left_ - result.judging * result.coefficients;
  return result;
}

void Projection::add(const Trial& trial) {
  const RowMatrix fitted = trial.fitted * trial.to_basis, judging = trial.judging * trial.to_basis;
  const RowMatrix beliefs = trial.beliefs * trial.to_basis;
  const Eigen::VectorXd share = fitted.transpose() * left_ + beliefs.transpose() * beliefs_left_;
  left_ -= fitted * share;
  judging_left_ -= judging * share;
  beliefs_left_ -= beliefs * share;
  append(basis_, fitted);
  append(judging_basis_, judging);
  append(beliefs_basis_, beliefs);
}

}  // namespace demecal
