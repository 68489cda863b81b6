// Derivatives against central differences.
#include "expression/simplify.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

double slope(std::string_view formula, double theta) {
  return evaluate(derivative(parse(formula), 0), {&theta, 1});
}

double difference_quotient(const Tree& tree, std::vector<double> point, std::size_t variable, double step) {
  const double middle = point[variable];
  point[variable] = middle + step;
  const double ahead = evaluate(tree, point);
  point[variable] = middle - step;
  return (ahead - evaluate(tree, point)) / (2.0 * step);
}

TEST(Derivative, AgreesWithCentralDifferencesOnRandomTrees) {
  RandomStream random{5, 1};
  int compared = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Tree tree = random_tree(random, 5, 2);
    const std::vector<double> point{random.real(-2.0, 2.0), random.real(-2.0, 2.0)};
    const std::size_t variable = random.index(2);
    const double coarse = difference_quotient(tree, point, variable, 2e-5);
    const double fine = difference_quotient(tree, point, variable, 1e-5);
    const double scale = 1.0 + std::abs(fine) + std::abs(evaluate(tree, point));
    // Where halving the step changes the quotient, a jump or a pole is near and differences say nothing.
    if (!(std::abs(coarse - fine) < 1e-7 * scale)) continue;
    const Tree exact = derivative(tree, static_cast<std::uint8_t>(variable));
    ASSERT_TRUE(is_valid(exact, 2));
    EXPECT_NEAR(evaluate(exact, point), fine, 1e-6 * scale) << to_string(tree, {"a", "b"});
    ++compared;
  }
  EXPECT_GT(compared, 3000);
}

TEST(Derivative, IsZeroWhereTheFormulaIsConstant) {
  for (const std::string formula :
       {"0.5", "theta - theta", "SIN(theta - theta)", "SQRTp(theta - theta)", "1 % (theta - theta)", "theta % theta",
        "SIGN(theta) + 2", "theta % (theta * (theta - theta)) * 0.5", "0 * SIN(theta)"}) {
    EXPECT_EQ(derivative(parse(formula), 0), constant_tree(0.0)) << formula;
  }
}

TEST(Derivative, LeavesOutTermsThatAreZero) {
  EXPECT_EQ(to_string(derivative(parse("SIN(0.5 * theta)"), 0)), "COS(0.5 * theta) * 0.5");
  EXPECT_EQ(to_string(derivative(parse("theta + 3 * theta"), 0)), "4");
  EXPECT_EQ(to_string(derivative(parse("theta % 4"), 0)), "0.25");
}

TEST(Derivative, OfAQuotientIsThatOfThePiecesBesideAZeroDivisor) {
  EXPECT_EQ(slope("theta % theta", 0.0), 0.0);
  EXPECT_NEAR(slope("1 % theta", 1e-3), -1e6, 1e-6);
  // Divisors that are zero on a whole side, where % is 1.
  EXPECT_EQ(slope("theta % (SIGN(theta) - 1)", 0.7), 0.0);
  EXPECT_EQ(slope("theta % (SIGN(theta) - 1)", -0.7), -0.5);
  EXPECT_EQ(slope("theta % (theta - SQRTp(theta * theta))", 0.5), 0.0);
  EXPECT_EQ(slope("SQRTp(theta - SQRTp(theta * theta))", 0.5), 0.0);
}

TEST(Derivative, RegardsOtherVariablesAsConstant) {
  const VariableNames names{"a", "b"};
  EXPECT_EQ(to_string(derivative(parse("a * b", names), 0), names), "b");
  EXPECT_EQ(derivative(parse("SIN(a)", names), 1), constant_tree(0.0));
}

TEST(Derivative, HasFiniteConstantsWhereFoldingWouldOverflow) {
  EXPECT_TRUE(is_valid(derivative(parse("theta * 1e300 * 1e300"), 0), 1));
}

}  // namespace
}  // namespace demecal
