// Values of formulas at points, over rows, and of many formulas at once.
#include <gtest/gtest.h>

#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "random_formulas.hpp"

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
      EXPECT_TRUE(same_bits(values[row], evaluate(tree, point)))
          << to_string(tree, {"a", "b", "c"}) << " in row " << row;
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

// Batches bred from each other, so that they share subtrees; some formulas are dropped in between.
void expect_batches_like_points(RandomStream& random, const std::vector<std::vector<double>>& columns,
                                std::size_t budget_bytes) {
  const std::size_t rows = columns.front().size();
  NodeStore store;
  SharedEvaluator shared(columns, budget_bytes);
  std::vector<Tree> trees;
  for (int i = 0; i < 12; ++i) trees.push_back(random_tree(random, 5, static_cast<int>(columns.size())));
  for (int batch = 0; batch < 6; ++batch) {
    std::vector<NodeId> roots;
    for (const Tree& tree : trees) roots.push_back(store.enter(tree));
    std::vector<std::vector<double>> values(trees.size(), std::vector<double>(padded(rows)));
    shared.bind(store, roots);
    shared.run([&](std::size_t formula, std::size_t begin, const double* strip, std::size_t strip_rows) {
      std::copy_n(strip, strip_rows, values[formula].begin() + static_cast<std::ptrdiff_t>(begin));
    });
    for (std::size_t i = 0; i < trees.size(); ++i) {
      for (std::size_t row = 0; row < padded(rows); ++row) {
        std::vector<double> point;
        for (const std::vector<double>& column : columns) point.push_back(column[std::min(row, rows - 1)]);
        ASSERT_TRUE(same_bits(values[i][row], evaluate(trees[i], point))) << "row " << row << " batch " << batch;
      }
    }
    for (std::size_t i = 0; i < trees.size(); i += 2) {
      const Tree other = trees[random.index(trees.size())];
      trees[i] = random.chance(0.3) ? apply(Primitive::sine, other) : apply(Primitive::add, trees[i], other);
      if (trees[i].size() > 60) trees[i] = random_tree(random, 4, static_cast<int>(columns.size()));
    }
    if (batch % 2 == 1) shared.forget(store.collect(std::vector<NodeId>(roots.begin(), roots.begin() + 5)));
  }
}

TEST(SharedEvaluator, GivesTheBitsOfEvaluateWhateverIsKept) {
  RandomStream random{8, 1};
  for (const std::size_t rows : {1, 8, 30, 257, 513, 700}) {
    const std::size_t column_bytes = padded(rows) * sizeof(double);
    for (const std::size_t kept_columns : {0, 1, 3, 17, 5000}) {
      expect_batches_like_points(random, random_columns(random, 2, rows, 3.0), kept_columns * column_bytes);
    }
  }
}

TEST(SharedEvaluator, GivesTheBitsOfEvaluateForHugeAngles) {
  RandomStream random{8, 2};
  for (int trial = 0; trial < 20; ++trial)
    expect_batches_like_points(random, random_columns(random, 1, 19, 1e9), 100'000);
}

class SharedWork : public testing::Test {
 protected:
  SharedWork() : columns{random_columns(random, 1, 30, 3.0)} {}
  std::size_t functions_for(SharedEvaluator& evaluator, const std::vector<Tree>& trees) {
    std::vector<NodeId> roots;
    for (const Tree& tree : trees) roots.push_back(store.enter(tree));
    evaluator.bind(store, roots);
    evaluator.run([](std::size_t, std::size_t, const double*, std::size_t) {});
    return evaluator.functions_bound();
  }
  RandomStream random{8, 3};
  std::vector<std::vector<double>> columns;
  NodeStore store;
  Tree sine = apply(Primitive::sine, variable_tree(0));
  Tree twice = apply(Primitive::add, sine, sine);
  Tree square = apply(Primitive::multiply, twice, twice);
};

TEST_F(SharedWork, EvaluatesEverySubtreeOfABatchOnce) {
  SharedEvaluator evaluator(columns, 0);
  EXPECT_EQ(functions_for(evaluator, {square, twice, sine, square, apply(Primitive::sine, constant_tree(1.0))}), 3u);
  EXPECT_EQ(functions_for(evaluator, {square}), 3u);
}

TEST_F(SharedWork, EvaluatesNothingAgainWhileItIsKept) {
  SharedEvaluator evaluator(columns, 1 << 20);
  EXPECT_EQ(functions_for(evaluator, {square}), 3u);
  EXPECT_EQ(functions_for(evaluator, {apply(Primitive::cosine, twice)}), 1u);
  evaluator.forget(store.collect({}));
  EXPECT_EQ(functions_for(evaluator, {apply(Primitive::cosine, twice)}), 3u);
}

TEST_F(SharedWork, KeepsWhatABatchUsesMostWhereMemoryIsShort) {
  SharedEvaluator evaluator(columns, padded(30) * sizeof(double));
  const auto plus = [&](double constant) { return apply(Primitive::add, sine, constant_tree(constant)); };
  // The sine is used four times, the sums once each.
  EXPECT_EQ(functions_for(evaluator, {apply(Primitive::multiply, plus(1.0), plus(2.0)),
                                      apply(Primitive::multiply, plus(3.0), plus(4.0))}),
            7u);
  EXPECT_EQ(functions_for(evaluator, {apply(Primitive::multiply, plus(1.0), plus(5.0))}), 3u);
}

TEST_F(SharedWork, KeepsNoMoreThanItsBudget) {
  constexpr std::size_t kBudget = 64 * 1024;
  SharedEvaluator small(columns, kBudget), large(columns, std::size_t{1} << 30);
  std::vector<Tree> trees;
  for (int i = 0; i < 400; ++i) trees.push_back(random_tree(random, 6));
  functions_for(small, trees);
  functions_for(large, trees);
  EXPECT_LT(small.kept_bytes(), kBudget + 1);
  EXPECT_GT(large.kept_bytes(), kBudget);
}

}  // namespace
}  // namespace demecal
