// Decompositions by what they are: products give the matrix back, solutions solve, whatever the shape of the right
// side.
#include "decompositions/decompositions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr double kTight = 1e-10;

Eigen::MatrixXd random_matrix(RandomStream& stream, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = stream.normal();
  return matrix;
}

/// A A' + 0.1: its condition is bounded.
Eigen::MatrixXd positive(RandomStream& stream, Eigen::Index size) {
  const Eigen::MatrixXd half = random_matrix(stream, size, size);
  return half * half.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

/// rows x columns of a given rank.
Eigen::MatrixXd of_rank(RandomStream& stream, Eigen::Index rows, Eigen::Index columns, Eigen::Index rank) {
  return random_matrix(stream, rows, rank) * random_matrix(stream, rank, columns);
}

TEST(Decompositions, OfPositiveMatricesSolveForEveryShape) {
  RandomStream stream{901, 1};
  for (const Eigen::Index size : {1, 2, 3, 6, 40}) {
    const Eigen::MatrixXd a = positive(stream, size), b = random_matrix(stream, size, 4);
    const Eigen::MatrixXd wide = random_matrix(stream, 4, size);
    const Cholesky plain(a);
    const PivotedCholesky pivoted(a);
    ASSERT_TRUE(plain.succeeded());
    EXPECT_TRUE(pivoted.is_positive());
    EXPECT_LT((plain.lower() * plain.lower().transpose() - a).norm(), kTight * a.norm());
    EXPECT_LT((pivoted.root() * pivoted.root().transpose() - a).norm(), kTight * a.norm());
    EXPECT_NEAR(plain.log_determinant(), std::log(a.determinant()), 1e-8);
    EXPECT_LT((a * plain.inverse() - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-8);
    EXPECT_LT((plain.lower() * plain.whitened(b) - b).norm(), 1e-8);
    EXPECT_LT((plain.lower() * plain.whitened(b.col(0)) - b.col(0)).norm(), 1e-8);
    for (const Eigen::MatrixXd& x : {Eigen::MatrixXd(plain.solve(b)), Eigen::MatrixXd(pivoted.solve(b))})
      EXPECT_LT((a * x - b).norm(), 1e-8);
    for (const Eigen::VectorXd& x : {plain.solve(b.col(1)), pivoted.solve(b.col(1))})
      EXPECT_LT((a * x - b.col(1)).norm(), 1e-8);
    EXPECT_LT((a * plain.solve(wide.transpose()) - wide.transpose()).norm(), 1e-8);
    EXPECT_LT((a * pivoted.solve(wide.transpose()) - wide.transpose()).norm(), 1e-8);
  }
}

TEST(Decompositions, SayWhereAMatrixIsNotPositive) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3, 3);
  a(2, 2) = -1.0;
  EXPECT_FALSE(Cholesky(a).succeeded());
  EXPECT_FALSE(PivotedCholesky(a).is_positive());
}

TEST(Decompositions, OfThreeRowsSolveAsThoseOfAny) {
  RandomStream stream{901, 2};
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d a = positive(stream, 3);
    const Eigen::Vector3d b = random_matrix(stream, 3, 1);
    EXPECT_LT((a * solve_pivoted(a, b) - b).norm(), 1e-9);
    EXPECT_LT((a * solve_positive(a, b) - b).norm(), 1e-9);
    const auto three = eigen_system_of_three(a);
    EXPECT_LT((three.values - eigen_system(a).values).norm(), 1e-9 * a.norm());
    EXPECT_LT((a * three.vectors - three.vectors * three.values.asDiagonal()).norm(), 1e-9 * a.norm());
  }
}

TEST(Decompositions, TakeMatricesApartAndTogetherAgain) {
  RandomStream stream{901, 3};
  const Eigen::MatrixXd a = random_matrix(stream, 9, 5), square = positive(stream, 7);
  const auto eigen = eigen_system(square);
  EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - square).norm(),
            kTight * square.norm());
  const SingularSystem singular = singular_system(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  EXPECT_LT((singular.u * singular.values.asDiagonal() * singular.v.transpose() - a).norm(), kTight * a.norm());
  EXPECT_EQ(singular_system(a).values, singular.values);
  EXPECT_EQ(singular_system(a).u.size(), 0);
  const Eigen::MatrixXd upper = upper_factor(a);
  EXPECT_EQ(upper.rows(), 5);
  EXPECT_TRUE(upper.isUpperTriangular());
  EXPECT_LT((orthogonal_factor(a, 5) * upper - a).norm(), kTight * a.norm());
  const Eigen::MatrixXd q = orthogonal_factor(a, 9);
  EXPECT_LT((q.transpose() * q - Eigen::MatrixXd::Identity(9, 9)).norm(), kTight);
}

TEST(Decompositions, KnowTheRankOfDependentColumns) {
  RandomStream stream{901, 4};
  for (const Eigen::Index rank : {1, 3, 5}) {
    const Eigen::MatrixXd a = of_rank(stream, 12, 5, rank);
    const PivotedQr qr(a, 1e-9);
    ASSERT_EQ(qr.rank(), rank);
    const Eigen::MatrixXd made = a * qr.to_basis();
    EXPECT_LT((made.transpose() * made - Eigen::MatrixXd::Identity(rank, rank)).norm(), 1e-8);
    EXPECT_LT((qr.basis() * (qr.basis().transpose() * a) - a).norm(), 1e-9 * a.norm());
    EXPECT_LT((qr.turned_back(qr.turned(a)) - a).norm(), 1e-9 * a.norm());
    const MoorePenroseInverse inverse = moore_penrose_inverse(a, 1e-9);
    EXPECT_EQ(inverse.rank, rank);
    EXPECT_LT((a * inverse.inverse * a - a).norm(), 1e-9 * a.norm());
    EXPECT_LT((moore_penrose_inverse(a).inverse - inverse.inverse).norm(), 1e-8 * inverse.inverse.norm());
  }
}

TEST(Decompositions, FindTheLeastSquaresSolutionOfLeastLength) {
  RandomStream stream{901, 5};
  const Eigen::MatrixXd full = random_matrix(stream, 12, 5), b = random_matrix(stream, 12, 2);
  const Eigen::VectorXd x = least_squares_solution(full, b.col(0));
  EXPECT_LT((full.transpose() * (full * x - b.col(0))).norm(), 1e-9);
  EXPECT_LT((PivotedQr(full).solve(b.col(0)) - x).norm(), 1e-9);
  const Eigen::MatrixXd a = of_rank(stream, 12, 5, 3);
  const Eigen::VectorXd shortest = least_norm_solution(a, b.col(0));
  EXPECT_LT((a.transpose() * (a * shortest - b.col(0))).norm(), 1e-8);
  EXPECT_LT((shortest - moore_penrose_inverse(a).inverse * b.col(0)).norm(), 1e-8);
  EXPECT_LT((least_norm_solutions(a, b).col(0) - shortest).norm(), 1e-9);
}

TEST(Decompositions, FindRotationsAndMotions) {
  RandomStream stream{901, 6};
  for (int i = 0; i < 20; ++i) {
    const Eigen::Quaterniond turn(stream.normal(), stream.normal(), stream.normal(), stream.normal());
    const Eigen::Matrix3d rotation = turn.normalized().toRotationMatrix();
    // Stretched along any axes, and never a reflection.
    const Eigen::Matrix3d axes = orthogonal_factor(random_matrix(stream, 3, 3), 3);
    const Eigen::Vector3d stretch(stream.real(0.5, 2), stream.real(0.5, 2), stream.real(0.5, 2));
    const Eigen::Matrix3d stretched = rotation * axes * stretch.asDiagonal() * axes.transpose();
    EXPECT_LT((nearest_rotation(stretched) - rotation).norm(), 1e-10);
    EXPECT_NEAR(nearest_rotation(-stretched).determinant(), 1.0, 1e-12);
    const Eigen::Vector3d shift = random_matrix(stream, 3, 1);
    const Eigen::Matrix3Xd from = random_matrix(stream, 3, 8), to = (rotation * from).colwise() + shift;
    const Eigen::Isometry3d motion = rigid_motion(from, to);
    EXPECT_LT((motion.linear() - rotation).norm(), 1e-9);
    EXPECT_LT((motion.translation() - shift).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace demecal
