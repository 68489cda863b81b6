// Fitness: the weighted sum of absolute errors, infinite where a formula has no value.
#include "evolution/fitness.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "evolution/tree_generation.hpp"
#include "lessons.hpp"

namespace demecal {
namespace {

TEST(Fitness, IsTheWeightedSumOfAbsoluteErrors) {
  RandomStream random{21};
  const TrainingTable table = two_variable_lesson(random);
  const NodeSet nodes = node_set(GpParameters{}, 2);
  Fitness fitness(table);
  int finite = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Tree tree;
    append_grown(random, nodes, 6, tree);
    double expected = 0.0;
    for (std::size_t row = 0; row < table.target.size(); ++row) {
      const std::vector<double> point{table.variables[0][row], table.variables[1][row]};
      expected += table.weight[row] * std::abs(table.target[row] - evaluate(tree, point));
    }
    if (!std::isfinite(expected)) continue;
    ++finite;
    ASSERT_NEAR(fitness(tree), expected, 1e-12 * expected);
  }
  EXPECT_GT(finite, 450);
}

TEST(Fitness, IsTheWeightedSumOfSquaresWhereTheTableSaysSo) {
  RandomStream random{22};
  TrainingTable table = two_variable_lesson(random, 37);
  table.loss = Loss::squared;
  const NodeSet nodes = node_set(GpParameters{}, 2);
  Fitness fitness(table);
  int finite = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Tree tree;
    append_grown(random, nodes, 5, tree);
    double expected = 0.0;
    for (std::size_t row = 0; row < table.target.size(); ++row) {
      const std::vector<double> point{table.variables[0][row], table.variables[1][row]};
      expected += table.weight[row] * std::pow(table.target[row] - evaluate(tree, point), 2);
    }
    if (!std::isfinite(expected)) continue;
    ++finite;
    ASSERT_NEAR(fitness(tree), expected, 1e-12 * expected);
  }
  EXPECT_GT(finite, 150);
}

TEST(Fitness, OfTheNeutralModelIsTheSizeOfTheTarget) {
  const TrainingTable table{{{1.0, 2.0, 3.0}}, {0.5, -1.0, 2.0}, {1.0, 1.0, 0.5}};
  EXPECT_DOUBLE_EQ(Fitness(table)(neutral_tree()), 2.5);
}

TEST(Fitness, IsInfiniteWhereARowIsNotFiniteEvenWithoutWeight) {
  Tree huge = constant_tree(1e200);
  huge = apply(Primitive::multiply, huge, apply(Primitive::multiply, huge, variable_tree(0)));
  for (const double weight : {0.0, 1.0}) {
    const TrainingTable table{{{1.0, 0.0}}, {0.0, 0.0}, {weight, 1.0}};
    EXPECT_EQ(Fitness(table)(huge), std::numeric_limits<double>::infinity());
  }
}

TEST(Fitness, IsInfiniteWhereARowIsNoNumber) {
  const Tree huge = apply(Primitive::multiply, constant_tree(1e200), constant_tree(1e200));
  const TrainingTable table{{{1.0}}, {0.0}, {1.0}};
  EXPECT_EQ(Fitness(table)(apply(Primitive::subtract, huge, huge)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace demecal
