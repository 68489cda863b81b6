// The model that is reported: briefly described, not best on what it was fitted to.
#include "evolution/model_archive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evolution/island.hpp"
#include "expression/text.hpp"
#include "fitness/lessons.hpp"

namespace demecal {
namespace {

TrainingTable noisy_line(std::uint64_t seed) {
  RandomStream random{seed};
  TrainingTable table = smooth_lesson(30);
  for (std::size_t i = 0; i < 30; ++i) table.target[i] = 0.5 * table.variables[0][i] + 0.1 * random.normal();
  return table;
}

double mean_square(const TrainingTable& table, const Tree& tree) {
  double sum = 0.0;
  for (std::size_t i = 0; i < table.target.size(); ++i)
    sum += std::pow(table.target[i] - evaluate(tree, {&table.variables[0][i], 1}), 2);
  return sum / static_cast<double>(table.target.size());
}

TEST(ModelArchive, FitsConstantsToTheTrainingRowsOnly) {
  const TrainingTable training = noisy_line(1), validation = noisy_line(2);
  ModelArchive archive(training, validation, GpParameters{});
  EXPECT_EQ(archive.chosen(), nullptr);
  archive.offer({{parse("0.45 * theta"), 1.0}});
  double product = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < 30; ++i) {
    product += training.variables[0][i] * training.target[i];
    squares += training.variables[0][i] * training.variables[0][i];
  }
  const Tree expected = apply(Primitive::multiply, constant_tree(product / squares), variable_tree(0));
  const double both = mean_square(training, expected) + mean_square(validation, expected);
  const double offered = mean_square(training, parse("0.45 * theta")) + mean_square(validation, parse("0.45 * theta"));
  ASSERT_NE(archive.chosen(), nullptr);
  EXPECT_NEAR(archive.chosen()->fitness, 0.5 * std::min(both, offered), 1e-9);
}

TEST(ModelArchive, PrefersTheShorterOfTwoThatFitAlike) {
  const TrainingTable training = noisy_line(3), validation = noisy_line(4);
  ModelArchive archive(training, validation, GpParameters{});
  archive.offer({{parse("0.5 * theta"), 2.0}, {parse("0.5 * theta + 0.02 * SIN(9 * theta)"), 1.0}});
  EXPECT_EQ(archive.chosen()->tree.size(), 3u);
}

TEST(ModelArchive, LeavesOutWhatIsNotFiniteOnARow) {
  TrainingTable training = noisy_line(5), validation = noisy_line(6);
  ModelArchive archive(training, validation, GpParameters{});
  Tree huge = constant_tree(1e200);
  huge = apply(Primitive::multiply, huge, apply(Primitive::multiply, huge, variable_tree(0)));
  archive.offer({{huge, 1.0}});
  EXPECT_EQ(archive.chosen(), nullptr);
}

// The best on the training rows is longer and errs more on rows that nobody saw.
TEST(ModelArchive, ChoosesShorterAndTruerModelsThanTheBestOnTraining) {
  GpParameters parameters = small_parameters();
  parameters.constants = ConstantPolicy::lamarckian;
  parameters.linear_scaling = true;
  Archipelago archipelago;
  archipelago.joints = {0};
  double chosen_nodes = 0.0, best_nodes = 0.0, chosen_square = 0.0, best_square = 0.0;
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    const TrainingTable training = noisy_line(seed), validation = noisy_line(seed + 100),
                        unseen = noisy_line(seed + 200);
    ModelArchive archive(training, validation, parameters);
    Island island(parameters, archipelago, training, {0, 0}, seed);
    while (!island.finished()) {
      island.run_epoch({});
      archive.offer(island.state().front);
    }
    const Tree& best = island.state().front.back().tree;
    chosen_nodes += static_cast<double>(archive.chosen()->tree.size());
    best_nodes += static_cast<double>(best.size());
    chosen_square += mean_square(unseen, archive.chosen()->tree);
    best_square += std::min(mean_square(unseen, best), 1.0);
  }
  EXPECT_LT(3.0 * chosen_nodes, best_nodes);
  EXPECT_LT(chosen_square, best_square);
}

}  // namespace
}  // namespace demecal
