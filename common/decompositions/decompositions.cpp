#include "decompositions/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <memory>
#include <utility>

#include "primitives/elementary.hpp"

namespace demecal::inline decompositions {
namespace {

using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename Right>
Right with_lower_solved(const Eigen::MatrixXd& lower, Right b) {
  lower.triangularView<Eigen::Lower>().solveInPlace(b);
  return b;
}

template <typename Right>
Right with_both_solved(const Eigen::MatrixXd& lower, Right b) {
  lower.triangularView<Eigen::Lower>().solveInPlace(b);
  lower.adjoint().triangularView<Eigen::Upper>().solveInPlace(b);
  return b;
}

/// (L L^T)^-1 by the rows of L^-1, of which only the lower triangle is worked out: a sixth of what solving for every
/// column of the identity takes. `lower` column by column, `inverse` full and zero at first.
DEMECAL_FOR_EACH_VECTOR_UNIT
void invert_product(Eigen::Index size, const double* lower, double* rows, double* inverse) {
  for (Eigen::Index i = 0; i < size; ++i) {
    double* const row = rows + i * size;
    row[i] = 1.0;
    for (Eigen::Index k = 0; k < i; ++k) {
      const double factor = lower[k * size + i];
      const double* const above = rows + k * size;
      DEMECAL_ROWS_APART
      for (Eigen::Index j = 0; j <= k; ++j) row[j] -= factor * above[j];
    }
    const double over = 1.0 / lower[i * size + i];
    for (Eigen::Index j = 0; j <= i; ++j) row[j] *= over;
    for (Eigen::Index k = 0; k <= i; ++k) {
      const double factor = row[k];
      double* const sum = inverse + k * size;
      DEMECAL_ROWS_APART
      for (Eigen::Index j = 0; j <= k; ++j) sum[j] += factor * row[j];
    }
  }
}

Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted_qr(const Eigen::MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(threshold);
  qr.compute(a);
  return qr;
}

MoorePenroseInverse inverse_and_rank(const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>& decomposition) {
  return {decomposition.pseudoInverse(), decomposition.rank()};
}

}  // namespace

Cholesky::Cholesky(const Eigen::MatrixXd& a) {
  Eigen::LLT<Eigen::MatrixXd> decomposition(a);
  succeeded_ = decomposition.info() == Eigen::Success;
  factors_ = decomposition.matrixLLT();
}

double Cholesky::log_determinant() const {
  return 2.0 * factors_.diagonal().array().log().sum();
}

Eigen::MatrixXd Cholesky::inverse() const {
  RowMajorXd rows = RowMajorXd::Zero(factors_.rows(), factors_.cols()), inverse = rows;
  invert_product(factors_.rows(), factors_.data(), rows.data(), inverse.data());
  return inverse.selfadjointView<Eigen::Lower>();
}

Eigen::VectorXd Cholesky::solved(Eigen::VectorXd b) const {
  return with_both_solved(factors_, std::move(b));
}
Eigen::MatrixXd Cholesky::solved(Eigen::MatrixXd b) const {
  return with_both_solved(factors_, std::move(b));
}
RowMajorXd Cholesky::solved(RowMajorXd b) const {
  return with_both_solved(factors_, std::move(b));
}

Eigen::VectorXd Cholesky::by_lower(Eigen::VectorXd b) const {
  return with_lower_solved(factors_, std::move(b));
}
Eigen::MatrixXd Cholesky::by_lower(Eigen::MatrixXd b) const {
  return with_lower_solved(factors_, std::move(b));
}
RowMajorXd Cholesky::by_lower(RowMajorXd b) const {
  return with_lower_solved(factors_, std::move(b));
}

struct PivotedCholesky::Factors {
  Eigen::LDLT<Eigen::MatrixXd> ldlt;
};

PivotedCholesky::PivotedCholesky(const Eigen::MatrixXd& a)
    : factors_(std::make_shared<const Factors>(Factors{Eigen::LDLT<Eigen::MatrixXd>(a)})) {}

bool PivotedCholesky::is_positive() const {
  return factors_->ldlt.info() == Eigen::Success && factors_->ldlt.isPositive();
}

Eigen::MatrixXd PivotedCholesky::root() const {
  const Eigen::VectorXd roots = factors_->ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd lower = factors_->ldlt.matrixL();
  return factors_->ldlt.transpositionsP().transpose() * (lower * roots.asDiagonal());
}

Eigen::VectorXd PivotedCholesky::solved(const Eigen::VectorXd& b) const {
  return factors_->ldlt.solve(b);
}
Eigen::MatrixXd PivotedCholesky::solved(const Eigen::MatrixXd& b) const {
  return factors_->ldlt.solve(b);
}
RowMajorXd PivotedCholesky::solved(const RowMajorXd& b) const {
  return factors_->ldlt.solve(b);
}

Eigen::Vector3d solve_pivoted(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.ldlt().solve(b);
}

Eigen::Vector3d solve_positive(const Eigen::Matrix3d& a, const Eigen::Vector3d& b) {
  return a.llt().solve(b);
}

EigenSystem<3> eigen_system_of_three(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

EigenSystem<Eigen::Dynamic> eigen_system(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

SingularSystem singular_system(const Eigen::MatrixXd& a, unsigned int which) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, which);
  SingularSystem system{svd.singularValues(), {}, {}};
  if (svd.computeU()) system.u = svd.matrixU();
  if (svd.computeV()) system.v = svd.matrixV();
  return system;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double turn = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * Eigen::Vector3d(1, 1, turn < 0 ? -1 : 1).asDiagonal() * svd.matrixV().transpose();
}

Eigen::Isometry3d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return Eigen::Isometry3d(Eigen::umeyama(from, to, false));
}

Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  return qr.matrixQR().topRows(std::min(a.rows(), a.cols())).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& a, Eigen::Index count) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  return qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), count);
}

Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.householderQr().solve(b);
}

struct PivotedQr::Factors {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
};

PivotedQr::PivotedQr(const Eigen::MatrixXd& a)
    : factors_(std::make_shared<const Factors>(Factors{Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(a)})) {}
PivotedQr::PivotedQr(const Eigen::MatrixXd& a, double threshold)
    : factors_(std::make_shared<const Factors>(Factors{pivoted_qr(a, threshold)})) {}

Eigen::Index PivotedQr::rank() const {
  return factors_->qr.rank();
}

Eigen::VectorXd PivotedQr::solve(const Eigen::VectorXd& b) const {
  return factors_->qr.solve(b);
}

Eigen::MatrixXd PivotedQr::basis() const {
  return factors_->qr.householderQ() * Eigen::MatrixXd::Identity(factors_->qr.rows(), rank());
}

Eigen::MatrixXd PivotedQr::to_basis() const {
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(factors_->qr.cols(), rank());
  padded.topRows(rank()) = factors_->qr.matrixR()
                               .topLeftCorner(rank(), rank())
                               .triangularView<Eigen::Upper>()
                               .solve(Eigen::MatrixXd::Identity(rank(), rank()));
  return factors_->qr.colsPermutation() * padded;
}

Eigen::MatrixXd PivotedQr::turned(Eigen::MatrixXd b) const {
  b.applyOnTheLeft(factors_->qr.householderQ());
  return b;
}

Eigen::MatrixXd PivotedQr::turned_back(Eigen::MatrixXd b) const {
  b.applyOnTheLeft(factors_->qr.householderQ().adjoint());
  return b;
}

Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd least_norm_solutions(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MoorePenroseInverse moore_penrose_inverse(const Eigen::MatrixXd& a) {
  return inverse_and_rank(a.completeOrthogonalDecomposition());
}

MoorePenroseInverse moore_penrose_inverse(const Eigen::MatrixXd& a, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  decomposition.compute(a);
  return inverse_and_rank(decomposition);
}

}  // namespace demecal::inline decompositions
