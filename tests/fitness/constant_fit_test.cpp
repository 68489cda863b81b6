// Fits of constants: never worse, within limits, robust, and good at what they are for.
#include "fitness/constant_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evolution/tree_generation.hpp"
#include "expression/text.hpp"
#include "lessons.hpp"

namespace demecal {
namespace {

GpParameters fitting(int steps = 10) {
  GpParameters parameters;
  parameters.constants = ConstantPolicy::lamarckian;
  parameters.constant_steps = steps;
  return parameters;
}

std::vector<Tree> random_formulas(RandomStream& random, int count) {
  const NodeSet nodes = node_set(GpParameters{}, 2);
  std::vector<Tree> trees(static_cast<std::size_t>(count));
  for (Tree& tree : trees) append_grown(random, nodes, 6, tree);
  return trees;
}

TEST(ConstantFit, NeverRaisesFitnessAndHasItsBits) {
  RandomStream random{81};
  for (const std::size_t rows : {1, 12, 300}) {
    TrainingTable table = two_variable_lesson(random, rows);
    int better = 0;
    for (const bool scaling : {false, true}) {
      table.loss = scaling && rows == 12 ? Loss::squared : Loss::absolute;
      Fitness fitness(table);
      GpParameters parameters = fitting();
      parameters.linear_scaling = scaling;
      ConstantFit fit(table, parameters);
      NodeStore store;
      for (const Tree& tree : random_formulas(random, 100)) {
        const double before = fitness(tree);
        const FittedFormula fitted = fit(store, store.enter(tree), before);
        const Tree after = store.tree(fitted.root);
        ASSERT_LE(fitted.fitness, before);
        ASSERT_EQ(fitted.fitness, fitness(after));
        ASSERT_TRUE(is_valid(after, 2));
        better += fitted.fitness < before;
      }
    }
    EXPECT_GT(better, 60);
  }
}

TEST(ConstantFit, IsNeverWorseWithMoreSteps) {
  RandomStream random{82};
  const TrainingTable table = two_variable_lesson(random, 30);
  Fitness fitness(table);
  NodeStore store;
  for (const Tree& tree : random_formulas(random, 40)) {
    if (contains(tree, Primitive::sign)) continue;
    double before = fitness(tree);
    for (int steps = 1; steps < 12; ++steps) {
      ConstantFit fit(table, fitting(steps));
      const double after = fit(store, store.enter(tree), fitness(tree)).fitness;
      ASSERT_LE(after, before);
      before = after;
    }
  }
}

TEST(ConstantFit, KeepsTheLimitsWhereItScales) {
  RandomStream random{83};
  const TrainingTable table = two_variable_lesson(random, 20);
  GpParameters parameters = fitting();
  parameters.linear_scaling = true;
  parameters.max_tree_depth = 6;
  parameters.max_tree_nodes = 40;
  Fitness fitness(table);
  ConstantFit fit(table, parameters);
  NodeStore store;
  int scaled = 0;
  for (const Tree& tree : random_formulas(random, 300)) {
    if (tree.size() > 40) continue;
    const Tree fitted = store.tree(fit(store, store.enter(tree), fitness(tree)).root);
    ASSERT_LE(depth(fitted), 6);
    ASSERT_LE(fitted.size(), 40u);
    scaled += fitted.size() > tree.size();
  }
  EXPECT_GT(scaled, 30);
}

double wave(double theta) {
  return 0.8 * std::sin(1.3 * theta + 0.4) + 0.25;
}

TrainingTable wave_table(std::size_t rows) {
  TrainingTable table = smooth_lesson(rows);
  for (std::size_t i = 0; i < rows; ++i) table.target[i] = wave(table.variables[0][i]);
  return table;
}

double largest_miss(const Tree& tree) {
  double most = 0.0;
  for (double theta = -2.5; theta < 2.5; theta += 0.1)
    most = std::max(most, std::abs(evaluate(tree, std::span<const double>(&theta, 1)) - wave(theta)));
  return most;
}

TEST(ConstantFit, FindsTheConstantsOfAWaveAmongOutliers) {
  NodeStore store;
  const Tree start = parse("0.5 * SIN(1.1 * theta + 0.1) + 0.2");
  for (const std::size_t rows : {30, 400}) {
    TrainingTable table = wave_table(rows);
    for (std::size_t i = 0; i < rows; i += 7) table.target[i] += 3.0;
    ConstantFit fit(table, fitting(60));
    Fitness fitness(table);
    const FittedFormula fitted = fit(store, store.enter(start), fitness(start));
    EXPECT_LT(largest_miss(store.tree(fitted.root)), 0.01);
    const FittedFormula by_squares = fit.by_squares(store, store.enter(start));
    EXPECT_GT(largest_miss(store.tree(by_squares.root)), 0.1);
  }
}

TEST(ConstantFit, BySquaresEndsWhereNoStepIsBetter) {
  RandomStream random{84};
  TrainingTable table = wave_table(40);
  for (double& target : table.target) target += 0.1 * random.normal();
  ConstantFit fit(table, fitting(60));
  NodeStore store;
  const Tree fitted = store.tree(fit.by_squares(store, store.enter(parse("0.5 * SIN(1.1 * theta + 0.1) + 0.2"))).root);
  const auto squares = [&](const Tree& tree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < table.target.size(); ++i)
      sum += std::pow(table.target[i] - evaluate(tree, {&table.variables[0][i], 1}), 2);
    return sum;
  };
  const double least = squares(fitted);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    if (fitted[i].primitive != Primitive::constant) continue;
    for (const double by : {-0.01, 0.01}) {
      Tree moved = fitted;
      moved[i].value += by;
      EXPECT_GT(squares(moved), least);
    }
  }
}

TEST(ConstantFit, ScalesInClosedForm) {
  TrainingTable table = smooth_lesson(50);
  for (std::size_t i = 0; i < 50; ++i) table.target[i] = 3.0 - 0.02 * std::exp(0.0) * std::sin(table.variables[0][i]);
  GpParameters parameters;
  parameters.linear_scaling = true;
  ConstantFit fit(table, parameters);
  Fitness fitness(table);
  NodeStore store;
  const Tree sine = parse("SIN(theta)");
  EXPECT_LT(fit(store, store.enter(sine), fitness(sine)).fitness, 1e-12);
}

TEST(ConstantFit, MovesAJumpToItsPlace) {
  TrainingTable table = smooth_lesson(60);
  for (std::size_t i = 0; i < 60; ++i) table.target[i] = table.variables[0][i] > 0.83 ? 1.0 : -1.0;
  const Tree start = parse("SIGN(theta - 0.2)");
  Fitness fitness(table);
  ConstantFit fit(table, fitting());
  NodeStore store;
  EXPECT_GT(fitness(start), 10.0);
  EXPECT_LT(fit(store, store.enter(start), fitness(start)).fitness, 1e-9);
}

}  // namespace
}  // namespace demecal
