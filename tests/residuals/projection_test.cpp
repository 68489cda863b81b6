// The projection against explicit least squares with beliefs as further rows.
#include <gtest/gtest.h>

#include <cmath>

#include "decompositions/decompositions.hpp"
#include "measured_arm.hpp"

namespace demecal {
namespace {

constexpr Eigen::Index kFittedRows = 40, kJudging = 15;

struct Problem {
  ModelColumns model;
  Eigen::VectorXd fitted, validation;
};

/// `free` numbers of which nothing is believed and `believed` ones.
Problem random_problem(RandomStream& stream, Eigen::Index free, Eigen::Index believed) {
  const Eigen::Index n = free + believed;
  Problem problem{{random_matrix(stream, kFittedRows, n), random_matrix(stream, kJudging, n), Eigen::VectorXd::Zero(n),
                   Eigen::VectorXd::Zero(n)},
                  random_matrix(stream, kFittedRows, 1),
                  random_matrix(stream, kJudging, 1)};
  problem.model.fitted.col(0) *= 1e4;  // as columns of metres and radians differ
  problem.model.validation.col(0) *= 1e4;
  for (Eigen::Index i = free; i < n; ++i) {
    problem.model.precision[i] = stream.real(0.5, 20.0);
    problem.model.offset[i] = stream.normal();
  }
  return problem;
}

/// Makes the last free column a sum of two others, over both kinds of rows.
void make_dependent(Problem& problem, Eigen::Index column) {
  problem.model.fitted.col(column) = 2 * problem.model.fitted.col(0) - problem.model.fitted.col(1);
  problem.model.validation.col(column) = 2 * problem.model.validation.col(0) - problem.model.validation.col(1);
}

void append_columns(Problem& problem, const RowMatrix& fitted, const RowMatrix& validation) {
  ModelColumns& model = problem.model;
  const Eigen::Index n = model.fitted.cols(), m = fitted.cols();
  model.fitted.conservativeResize(Eigen::NoChange, n + m);
  model.fitted.rightCols(m) = fitted;
  model.validation.conservativeResize(Eigen::NoChange, n + m);
  model.validation.rightCols(m) = validation;
  model.precision.conservativeResizeLike(Eigen::VectorXd::Zero(n + m));
  model.offset.conservativeResizeLike(Eigen::VectorXd::Zero(n + m));
}

struct Solution {
  Eigen::VectorXd coefficients, left, validation_residual;
  Eigen::MatrixXd whole;  ///< rows of measurements, then of beliefs
  double squares = 0.0, freedom = 0.0;
};

Solution solve_explicitly(const Problem& problem) {
  const ModelColumns& model = problem.model;
  const Eigen::Index n = model.fitted.cols();
  Solution solution;
  solution.whole.resize(kFittedRows + n, n);
  solution.whole << model.fitted, Eigen::MatrixXd(model.precision.asDiagonal());
  Eigen::VectorXd wanted(kFittedRows + n);
  wanted << problem.fitted, -model.precision.cwiseProduct(model.offset);
  const Eigen::MatrixXd inverse = moore_penrose_inverse(solution.whole, 1e-10).inverse;
  solution.coefficients = inverse * wanted;
  solution.left = problem.fitted - model.fitted * solution.coefficients;
  solution.validation_residual = problem.validation - model.validation * solution.coefficients;
  solution.squares = (wanted - solution.whole * solution.coefficients).squaredNorm();
  solution.freedom = static_cast<double>(kFittedRows) - (model.fitted * inverse.leftCols(kFittedRows)).trace();
  return solution;
}

void expect_equal(const Projection& projection, const Solution& expected) {
  EXPECT_TRUE(projection.residual().isApprox(expected.left, 1e-9));
  EXPECT_TRUE(projection.validation_residual().isApprox(expected.validation_residual, 1e-8));
  EXPECT_NEAR(projection.squares(), expected.squares, 1e-9 * expected.squares);
  EXPECT_NEAR(projection.freedom(), expected.freedom, 1e-8);
}

TEST(Projection, IsTheLeastSquaresSolutionWithBeliefsAsFurtherRows) {
  RandomStream stream{82, 1};
  for (int trial = 0; trial < 20; ++trial) {
    const Problem problem = random_problem(stream, 5, 4);
    const Projection projection(problem.model, problem.fitted, problem.validation);
    const Solution expected = solve_explicitly(problem);
    expect_equal(projection, expected);
    EXPECT_EQ(projection.rank(), 9);
    EXPECT_TRUE(projection.changes().isApprox(expected.coefficients, 1e-8));
    EXPECT_TRUE(
        projection.covariance().isApprox(Cholesky(expected.whole.transpose() * expected.whole).inverse(), 1e-7));
  }
}

TEST(Projection, IsTheSameWhereColumnsDependOnEachOther) {
  RandomStream stream{82, 2};
  for (int trial = 0; trial < 20; ++trial) {
    Problem problem = random_problem(stream, 5, 4);
    make_dependent(problem, 4);
    const Projection projection(problem.model, problem.fitted, problem.validation);
    expect_equal(projection, solve_explicitly(problem));
    EXPECT_EQ(projection.rank(), 8);
  }
}

TEST(Projection, OfNoColumnsLeavesEverything) {
  RandomStream stream{82, 3};
  const Eigen::VectorXd fitted = random_matrix(stream, kFittedRows, 1), validation = random_matrix(stream, kJudging, 1);
  const Projection projection({RowMatrix(kFittedRows, 0), RowMatrix(kJudging, 0), {}, {}}, fitted, validation);
  EXPECT_EQ(projection.residual(), fitted);
  EXPECT_EQ(projection.validation_residual(), validation);
  EXPECT_EQ(projection.rank(), 0);
  EXPECT_DOUBLE_EQ(projection.freedom(), static_cast<double>(kFittedRows));
}

TEST(Projection, BasisIsOrthonormalTogetherWithBeliefs) {
  RandomStream stream{82, 4};
  const Problem problem = random_problem(stream, 5, 0);
  const Projection projection(problem.model, problem.fitted, problem.validation);
  EXPECT_TRUE((projection.basis().transpose() * projection.basis()).isIdentity(1e-10));
  const Problem believed = random_problem(stream, 3, 4);
  const RowMatrix basis = Projection(believed.model, believed.fitted, believed.validation).basis();
  EXPECT_LT(basis.squaredNorm(), 7.0 - 1e-3);
}

TEST(Projection, BasisIsOrthonormalHoweverNearAColumnIsToAnother) {
  RandomStream stream{82, 8};
  for (int power = 0; power <= 8; ++power) {
    if (power == 6) continue;  // about what counts as another direction still
    Problem problem = random_problem(stream, 5, 0);
    problem.model.fitted.col(4) = problem.model.fitted.col(2) + std::pow(10.0, -power) * problem.model.fitted.col(4);
    const Projection projection(problem.model, problem.fitted, problem.validation);
    EXPECT_EQ(projection.rank(), power < 6 ? 5 : 4) << power;
    EXPECT_TRUE((projection.basis().transpose() * projection.basis()).isIdentity(1e-6)) << power;
  }
}

TEST(Projection, TrialIsWhatFittingWithTheColumnsGives) {
  RandomStream stream{82, 5};
  for (int trial = 0; trial < 20; ++trial) {
    Problem problem = random_problem(stream, 4, 4);
    const Projection projection(problem.model, problem.fitted, problem.validation);
    const RowMatrix fitted = 1e3 * random_matrix(stream, kFittedRows, 3),
                    validation = 1e3 * random_matrix(stream, kJudging, 3);
    const Projection::Trial tried = projection.trial(fitted, validation);
    const double before = solve_explicitly(problem).squares;
    append_columns(problem, fitted, validation);
    const Solution expected = solve_explicitly(problem);
    EXPECT_EQ(tried.rank, 3);
    EXPECT_NEAR(tried.drop, before - expected.squares, 1e-8 * before);
    EXPECT_TRUE(tried.coefficients.isApprox(expected.coefficients.tail(3), 1e-8));
    EXPECT_TRUE(tried.validation_residual.isApprox(expected.validation_residual, 1e-8));
  }
}

TEST(Projection, TrialGivesNothingForWhatTheModelExplains) {
  RandomStream stream{82, 6};
  Problem problem = random_problem(stream, 4, 4);
  const Projection projection(problem.model, problem.fitted, problem.validation);
  RowMatrix fitted(kFittedRows, 2), validation(kJudging, 2);
  const auto known = [](const RowMatrix& columns) { return (1e-3 * columns.col(0) + columns.col(2)).eval(); };
  fitted << random_matrix(stream, kFittedRows, 1), known(problem.model.fitted);
  validation << random_matrix(stream, kJudging, 1), known(problem.model.validation);
  const Projection::Trial tried = projection.trial(fitted, validation);
  EXPECT_EQ(tried.rank, 1);
  EXPECT_NEAR(tried.coefficients[1], 0.0, 1e-9);
  const double before = projection.squares();
  append_columns(problem, fitted, validation);
  EXPECT_NEAR(tried.drop, before - solve_explicitly(problem).squares, 1e-7 * before);
  const Projection::Trial zero = projection.trial(RowMatrix::Zero(kFittedRows, 1), RowMatrix::Zero(kJudging, 1));
  EXPECT_EQ(zero.rank, 0);
  EXPECT_EQ(zero.drop, 0.0);
  EXPECT_EQ(zero.validation_residual, projection.validation_residual());
}

TEST(Projection, AddingIsTheSameAsFittingWithTheColumns) {
  RandomStream stream{82, 7};
  for (int trial = 0; trial < 10; ++trial) {
    Problem problem = random_problem(stream, 4, 4);
    Projection projection(problem.model, problem.fitted, problem.validation);
    for (const Eigen::Index count : {2, 1}) {
      const RowMatrix fitted = random_matrix(stream, kFittedRows, count),
                      validation = random_matrix(stream, kJudging, count);
      projection.add(projection.trial(fitted, validation));
      append_columns(problem, fitted, validation);
    }
    expect_equal(projection, solve_explicitly(problem));
    EXPECT_EQ(projection.rank(), 11);
    const RowMatrix next = random_matrix(stream, kFittedRows, 1), validation = random_matrix(stream, kJudging, 1);
    const Projection whole(problem.model, problem.fitted, problem.validation);
    EXPECT_NEAR(projection.trial(next, validation).drop, whole.trial(next, validation).drop, 1e-9);
  }
}

}  // namespace
}  // namespace demecal
