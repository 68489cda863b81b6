// Damped steps of least squares: they solve what they state, in a fixed order of sums.
#include "fitness/constant_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "primitives/columns.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

struct Problem {
  std::vector<AlignedColumn> slopes;
  AlignedColumn error, weight;

  Problem(RandomStream& random, std::size_t unknowns, std::size_t rows) : slopes(unknowns) {
    const auto fill = [&](AlignedColumn& column, double lower, double upper) {
      for (std::size_t i = 0; i < rows; ++i) column.push_back(random.real(lower, upper));
    };
    for (AlignedColumn& column : slopes) fill(column, -1.0, 1.0);
    fill(error, -1.0, 1.0);
    fill(weight, 0.0, 1.0);
  }

  void add_to(DampedNormalEquations& equations, std::size_t begin, std::size_t end) const {
    std::vector<const double*> columns;
    for (const AlignedColumn& column : slopes) columns.push_back(column.data() + begin);
    equations.add(columns, error.data() + begin, weight.data() + begin, end - begin);
  }
  double product(const AlignedColumn& a, const AlignedColumn& b) const {
    double sum = 0.0;
    for (std::size_t row = 0; row < weight.size(); ++row) sum += weight[row] * a[row] * b[row];
    return sum;
  }
};

TEST(DampedNormalEquations, AreSolvedByTheirSteps) {
  RandomStream random{51};
  DampedNormalEquations equations;
  for (const std::size_t unknowns : {1, 2, 5, 12}) {
    for (const double damping : {0.0, 1e-3, 10.0}) {
      const Problem problem(random, unknowns, 48);
      equations.clear(unknowns);
      problem.add_to(equations, 0, 48);
      ASSERT_TRUE(equations.finish());
      std::vector<double> step(unknowns);
      ASSERT_TRUE(equations.solve(damping, step));
      for (std::size_t i = 0; i < unknowns; ++i) {
        double left = problem.product(problem.slopes[i], problem.error);
        left -= damping * problem.product(problem.slopes[i], problem.slopes[i]) * step[i];
        for (std::size_t j = 0; j < unknowns; ++j)
          left -= problem.product(problem.slopes[i], problem.slopes[j]) * step[j];
        EXPECT_NEAR(left, 0.0, 1e-10);
      }
    }
  }
}

TEST(DampedNormalEquations, AreTheSameStripByStrip) {
  RandomStream random{52};
  const Problem problem(random, 4, 64);
  DampedNormalEquations whole, strips;
  whole.clear(4);
  strips.clear(4);
  problem.add_to(whole, 0, 64);
  problem.add_to(strips, 0, 24);
  problem.add_to(strips, 24, 64);
  ASSERT_TRUE(whole.finish() && strips.finish());
  std::vector<double> one(4), other(4);
  ASSERT_TRUE(whole.solve(1e-3, one) && strips.solve(1e-3, other));
  EXPECT_EQ(one, other);
}

TEST(DampedNormalEquations, LeaveUnknownsThatChangeNothing) {
  RandomStream random{53};
  Problem problem(random, 3, 32);
  problem.slopes[1].assign(32, 0.0);
  DampedNormalEquations equations;
  equations.clear(3);
  problem.add_to(equations, 0, 32);
  ASSERT_TRUE(equations.finish());
  std::vector<double> step(3);
  ASSERT_TRUE(equations.solve(0.0, step));
  EXPECT_EQ(step[1], 0.0);
  EXPECT_NE(step[0], 0.0);
  EXPECT_NE(step[2], 0.0);
}

TEST(DampedNormalEquations, SayWhereASumIsNotFinite) {
  RandomStream random{54};
  Problem problem(random, 2, 32);
  problem.slopes[1][7] = INFINITY;
  DampedNormalEquations equations;
  equations.clear(2);
  problem.add_to(equations, 0, 32);
  EXPECT_FALSE(equations.finish());
}

}  // namespace
}  // namespace demecal
