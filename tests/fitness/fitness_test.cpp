// The fitness of formulas one by one, and of populations whose formulas share their subtrees.
#include <gtest/gtest.h>

#include <limits>

#include "evolution/tree_generation.hpp"
#include "fitness/fitness.hpp"
#include "fitness/lessons.hpp"

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

TEST(SharedFitness, HasTheBitsOfFitness) {
  RandomStream random{22};
  const NodeSet nodes = node_set(GpParameters{}, 2);
  for (const std::size_t rows : {1, 7, 30, 513, 1300}) {
    TrainingTable table = two_variable_lesson(random, rows);
    if (rows % 2 == 0) table.loss = Loss::squared;
    Fitness fitness(table);
    SharedFitness shared(table);
    NodeStore store;
    for (int generation = 0; generation < 5; ++generation) {
      std::vector<Tree> trees(40);
      std::vector<NodeId> roots;
      for (Tree& tree : trees) append_grown(random, nodes, 6, tree);
      for (const Tree& tree : trees) roots.push_back(store.enter(tree));
      shared.bind(store, roots);
      shared.run();
      for (std::size_t i = 0; i < trees.size(); ++i) ASSERT_EQ(shared.of(roots[i]), fitness(trees[i]));
      roots.resize(10);
      shared.forget(store.collect(roots));
    }
  }
}

TEST(SharedFitness, IsInfiniteWhereARowIsNotFiniteEvenWithoutWeight) {
  Tree huge = constant_tree(1e200);
  huge = apply(Primitive::multiply, huge, apply(Primitive::multiply, huge, variable_tree(0)));
  for (const double weight : {0.0, 1.0}) {
    const TrainingTable table{{{1.0, 0.0}}, {0.0, 0.0}, {weight, 1.0}};
    NodeStore store;
    SharedFitness shared(table);
    const NodeId root = store.enter(huge);
    shared.bind(store, {&root, 1});
    shared.run();
    EXPECT_EQ(shared.of(root), std::numeric_limits<double>::infinity());
  }
}

TEST(ErrorSum, AddsRowsByTurnsIntoEightSums) {
  RandomStream random{23};
  const std::size_t rows = 53;
  std::vector<double> target(rows), weight(rows), values(padded(rows));
  for (std::size_t i = 0; i < rows; ++i)
    target[i] = random.real(), weight[i] = random.real(), values[i] = random.real();
  ErrorSum::Lanes sums{}, expected{};
  const ErrorSum errors(target, weight);
  errors.add(sums, 0, values.data(), 24);
  errors.add(sums, 24, values.data() + 24, values.size() - 24);
  for (std::size_t i = 0; i < rows; ++i) {
    const double error = weight[i] * std::abs(target[i] - values[i]);
    expected[i % 8] += error;
  }
  EXPECT_EQ(sums, expected);
}

}  // namespace
}  // namespace demecal
