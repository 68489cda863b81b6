// Values of formulas: what each primitive computes, and that columns of rows give what single points give.
#include "expression/evaluate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/text.hpp"
#include "random_columns.hpp"
#include "random_tree.hpp"

namespace demecal {
namespace {

double value(std::string_view formula, double theta) {
  return evaluate(parse(formula), {&theta, 1});
}

void expect_rows_like_points(RandomStream& random, const std::vector<std::vector<double>>& columns, int trees) {
  ColumnEvaluator evaluate_columns(columns);
  for (int trial = 0; trial < trees; ++trial) {
    const Tree tree = random_tree(random, 8, static_cast<int>(columns.size()));
    const std::span<const double> values = evaluate_columns(tree);
    ASSERT_EQ(values.size(), columns.front().size());
    for (std::size_t row = 0; row < values.size(); ++row) {
      std::vector<double> point;
      for (const std::vector<double>& column : columns) point.push_back(column[row]);
      EXPECT_TRUE(same_bits(values[row], evaluate(tree, point))) << to_text(tree, {"a", "b", "c"}) << " in row " << row;
    }
  }
}

TEST(Evaluate, ComputesThePrimitives) {
  EXPECT_EQ(value("theta + 0.5", 0.25), 0.75);
  EXPECT_EQ(value("theta - 0.5", 0.25), -0.25);
  EXPECT_EQ(value("theta * 0.5", 0.25), 0.125);
  EXPECT_EQ(value("theta % 0.5", 0.25), 0.5);
  EXPECT_NEAR(value("SIN(theta)", 0.25), std::sin(0.25), 1e-15);
  EXPECT_NEAR(value("COS(theta)", 0.25), std::cos(0.25), 1e-15);
  EXPECT_EQ(value("SIGN(theta)", -0.25), -1.0);
  EXPECT_EQ(value("SIGN(theta)", 0.0), 0.0);
  EXPECT_EQ(value("SIGN(theta)", 0.25), 1.0);
  EXPECT_EQ(value("SQRTp(theta)", 0.25), 0.5);
  EXPECT_EQ(value("ABS(theta)", -0.25), 0.25);
  EXPECT_EQ(value("ABS(theta)", 0.25), 0.25);
}

TEST(Evaluate, ProtectsQuotientAndRoot) {
  EXPECT_EQ(value("theta % 0", 7.0), 1.0);
  EXPECT_EQ(value("theta % (theta - theta)", 7.0), 1.0);
  EXPECT_EQ(value("theta % -0", 7.0), 1.0);
  EXPECT_EQ(value("SQRTp(theta)", -0.25), 0.5);
}

TEST(Evaluate, LetsWhatIsNotANumberStaySo) {
  EXPECT_TRUE(std::isnan(value("SIGN(SIN(theta * theta))", 1e200)));
}

TEST(Evaluate, CorrectsNothingByTheNeutralTree) {
  for (const double theta : {-2.5, 0.0, 1e9}) EXPECT_EQ(evaluate(neutral_tree(), {&theta, 1}), 0.0);
}

TEST(ColumnEvaluator, GivesTheBitsOfEvaluateForAnyNumberOfRows) {
  RandomStream random{3, 1};
  for (const std::size_t rows : {1, 2, 7, 8, 9, 30, 255, 256, 257, 600}) {
    expect_rows_like_points(random, random_columns(random, 1, rows, 3.0), 60);
  }
}

TEST(ColumnEvaluator, GivesTheBitsOfEvaluateForSeveralVariables) {
  RandomStream random{3, 2};
  expect_rows_like_points(random, random_columns(random, 3, 33, 3.0), 300);
}

TEST(ColumnEvaluator, GivesTheBitsOfEvaluateForAnglesTooLargeForVectors) {
  RandomStream random{3, 3};
  expect_rows_like_points(random, random_columns(random, 1, 17, 1e8), 300);
}

TEST(ColumnEvaluator, FillsEveryRowWithAConstant) {
  RandomStream random{3, 4};
  ColumnEvaluator evaluate_columns(random_columns(random, 1, 300, 1.0));
  for (const double value : evaluate_columns(parse("SIN(0.5) * 2 % 0.25"))) EXPECT_EQ(value, sine(0.5) * 2.0 / 0.25);
}

TEST(ColumnEvaluator, AcceptsATableWithoutRows) {
  const std::vector<std::vector<double>> columns(1);
  ColumnEvaluator evaluate_columns(columns);
  EXPECT_TRUE(evaluate_columns(neutral_tree()).empty());
}

}  // namespace
}  // namespace demecal
