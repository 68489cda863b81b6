// Decompositions of dense matrices, and what is solved by them: Eigen's, compiled once, since every file that names one
// of its templates takes the compiler several seconds.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <type_traits>

namespace demecal::inline decompositions {

/// What an expression is as a matrix: a vector, or a matrix with its own order of storage, by which sums are ordered.
template <typename Expression>
using PlainOf =
    std::conditional_t<Expression::ColsAtCompileTime == 1, Eigen::VectorXd,
                       Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic,
                                     bool(Expression::PlainObject::IsRowMajor) ? Eigen::RowMajor : Eigen::ColMajor>>;

/// a = L L^T of a symmetric positive definite matrix, of which the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& a);

  bool succeeded() const { return succeeded_; }  ///< false: a is not positive definite
  Eigen::MatrixXd lower() const { return factors_.triangularView<Eigen::Lower>(); }
  double log_determinant() const;
  /// a^-1 b.
  template <typename Right>
  PlainOf<Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solved(PlainOf<Right>(b));
  }
  Eigen::MatrixXd inverse() const;
  /// L^-1 b: independent and of unit variance where a is the covariance of b.
  template <typename Right>
  PlainOf<Right> whitened(const Eigen::MatrixBase<Right>& b) const {
    return by_lower(PlainOf<Right>(b));
  }

 private:
  Eigen::VectorXd solved(Eigen::VectorXd b) const;
  Eigen::MatrixXd solved(Eigen::MatrixXd b) const;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> solved(
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> b) const;
  Eigen::VectorXd by_lower(Eigen::VectorXd b) const;
  Eigen::MatrixXd by_lower(Eigen::MatrixXd b) const;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_lower(
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> b) const;

  Eigen::MatrixXd factors_;
  bool succeeded_ = false;
};

/// The same with pivots and without roots, a = P^T L D L^T P: for matrices that may be semidefinite or nearly so.
class PivotedCholesky {
 public:
  PivotedCholesky() = default;  ///< of nothing: must be assigned to before it is used
  explicit PivotedCholesky(const Eigen::MatrixXd& a);

  bool is_positive() const;  ///< and the decomposition succeeded
  /// A root of a, P^T L D^1/2, negative numbers of D taken as zero.
  Eigen::MatrixXd root() const;
  template <typename Right>
  PlainOf<Right> solve(const Eigen::MatrixBase<Right>& b) const {
    return solved(PlainOf<Right>(b));
  }

 private:
  Eigen::VectorXd solved(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solved(const Eigen::MatrixXd& b) const;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> solved(
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& b) const;

  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// a^-1 b of a symmetric matrix of three rows, by pivoted and by plain Cholesky decomposition.
Eigen::Vector3d solve_pivoted(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);
Eigen::Vector3d solve_positive(const Eigen::Matrix3d& a, const Eigen::Vector3d& b);

/// Of a symmetric matrix, of which the lower triangle is read: values ascend, vectors are columns.
template <int size>
struct EigenSystem {
  Eigen::Matrix<double, size, 1> values;
  Eigen::Matrix<double, size, size> vectors;
};
EigenSystem<3> eigen_system_of_three(const Eigen::Matrix3d& symmetric);
EigenSystem<Eigen::Dynamic> eigen_system(const Eigen::MatrixXd& symmetric);

/// a = U S V^T, values descending; U and V as `which` asks for (Eigen::ComputeThinU | Eigen::ComputeThinV, ...).
struct SingularSystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd u, v;  ///< empty where not asked for
};
SingularSystem singular_system(const Eigen::MatrixXd& a, unsigned int which = 0);

/// The rotation nearest to a matrix in the sum of squares.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);
/// The rigid motion that brings points nearest to others in the sum of squares (Umeyama, 1991); one column a point.
Eigen::Isometry3d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// R of a = Q R, min(rows, columns) x columns.
Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& a);
/// The first `count` columns of the square Q of a = Q R.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& a, Eigen::Index count);
/// The x of least |a x - b|, a of full column rank.
Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// a P = Q R with the columns of a in such an order that numbers on R's diagonal descend; those below `threshold` times
/// the largest count as zero (none given: rounding).
class PivotedQr {
 public:
  PivotedQr() = default;  ///< of nothing: must be assigned to before it is used
  explicit PivotedQr(const Eigen::MatrixXd& a);
  PivotedQr(const Eigen::MatrixXd& a, double threshold);

  Eigen::Index rank() const;
  /// A solution of least |a x - b|.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Orthonormal columns that span those of a: rows x rank.
  Eigen::MatrixXd basis() const;
  /// The matrix (columns x rank) by which the columns of a become orthonormal.
  Eigen::MatrixXd to_basis() const;
  /// Q b and Q^T b, Q square.
  Eigen::MatrixXd turned(Eigen::MatrixXd b) const;
  Eigen::MatrixXd turned_back(Eigen::MatrixXd b) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

/// Of all x of least |a x - b| the one of least length, whatever the rank of a.
Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd least_norm_solutions(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

struct MoorePenroseInverse {
  Eigen::MatrixXd inverse;
  Eigen::Index rank = 0;
};
MoorePenroseInverse moore_penrose_inverse(const Eigen::MatrixXd& a);
/// What is below `threshold` times the largest counts as zero.
MoorePenroseInverse moore_penrose_inverse(const Eigen::MatrixXd& a, double threshold);

}  // namespace demecal::inline decompositions
