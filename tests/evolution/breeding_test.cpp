// A generation bred from the one before.
#include "evolution/breeding.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "evolution/selection.hpp"
#include "lessons.hpp"

namespace demecal {
namespace {

Population first_population(RandomStream& random, const GpParameters& parameters, Fitness& fitness) {
  Population population;
  for (const Tree& tree : ramped_half_and_half(random, parameters, 1)) population.push_back({tree, fitness(tree)});
  return population;
}

TEST(Tournament, PrefersTheFitterTheMoreTheLargerItIs) {
  Population population(10);
  for (std::size_t i = 0; i < population.size(); ++i) population[i].fitness = static_cast<double>((i * 7) % 10);
  RandomStream random{71};
  constexpr int kDraws = 20000;
  for (const int size : {1, 2, 5}) {
    int best = 0;
    for (int i = 0; i < kDraws; ++i) best += population[tournament(random, population, size)].fitness == 0.0;
    const double expected = kDraws * (1.0 - std::pow(0.9, size));
    EXPECT_NEAR(best, expected, 4.0 * std::sqrt(expected));
  }
}

TEST(Tournament, FavoursNoPlaceAmongEquals) {
  const Population population(10);
  RandomStream random{72};
  std::vector<int> wins(10);
  for (int i = 0; i < 20000; ++i) ++wins[tournament(random, population, 5)];
  for (const int count : wins) EXPECT_NEAR(count, 2000, 200);
}

TEST(Ranking, OrdersByFitnessThenIndex) {
  Population population(6);
  const double values[]{3.0, 1.0, 2.0, 1.0, INFINITY, 2.0};
  for (std::size_t i = 0; i < 6; ++i) population[i].fitness = values[i];
  EXPECT_EQ(ranking(population), (std::vector<std::size_t>{1, 3, 2, 5, 0, 4}));
  EXPECT_EQ(fittest(population), 1u);
}

TEST(Breeding, KeepsLimitsSizeTrueFitnessAndTheBest) {
  const GpParameters parameters = small_parameters();
  const TrainingTable table = smooth_lesson();
  for (const std::uint64_t seed : {1, 2, 3}) {
    RandomStream random{73, seed};
    Fitness fitness(table);
    Breeder breeder(parameters, 1);
    Population population = first_population(random, parameters, fitness);
    for (int generation = 0; generation < 40; ++generation) {
      const Individual best = population[fittest(population)];
      const std::uint64_t evaluations = breeder.breed(random, population, fitness);
      ASSERT_LT(evaluations, population.size());
      ASSERT_EQ(population.size(), 60u);
      ASSERT_TRUE(population.front() == best);
      for (const Individual& one : population) {
        ASSERT_TRUE(is_valid(one.tree, 1));
        ASSERT_LE(depth(one.tree), parameters.max_tree_depth);
        ASSERT_TRUE(depth(one.tree) >= parameters.min_tree_depth || one.tree == neutral_tree());
        ASSERT_EQ(one.fitness, fitness(one.tree));
      }
    }
  }
}

TEST(Breeding, WithoutVariationReproducesParentsAndEvaluatesNothing) {
  GpParameters parameters = small_parameters();
  parameters.crossover_rate = parameters.mutation_rate = 0.0;
  const TrainingTable table = smooth_lesson();
  Fitness fitness(table);
  RandomStream random{74};
  Breeder breeder(parameters, 1);
  Population population = first_population(random, parameters, fitness);
  const Population parents = population;
  EXPECT_EQ(breeder.breed(random, population, fitness), 0u);
  for (const Individual& one : population)
    EXPECT_TRUE(std::any_of(parents.begin(), parents.end(), [&](const Individual& p) { return p == one; }));
}

TEST(Breeding, VariesAsManyAsItsTwoRatesSay) {
  GpParameters parameters = small_parameters();
  parameters.population_size = 2001;
  parameters.tournament_size = 1;
  const TrainingTable table = smooth_lesson(3);
  const auto reproduced_share = [&](double crossover_rate, double mutation_rate) {
    parameters.crossover_rate = crossover_rate;
    parameters.mutation_rate = mutation_rate;
    Fitness fitness(table);
    RandomStream random{75};
    Breeder breeder(parameters, 1);
    Population population = first_population(random, parameters, fitness);
    TreeIndex index(4002);
    const Population parents = population;
    for (std::size_t i = 0; i < parents.size(); ++i) index.enter(parents[i].tree, i);
    breeder.breed(random, population, fitness);
    int reproduced = 0;
    for (const Individual& one : population) reproduced += index.enter(one.tree, 2001) < 2001;
    return reproduced / 2001.0;
  };
  const double crossed_only = reproduced_share(1.0, 0.0), mutated_only = reproduced_share(0.0, 1.0);
  EXPECT_LT(crossed_only, 0.15);  // equal terminals swapped
  EXPECT_LT(mutated_only, 0.15);  // a terminal for itself
  EXPECT_NEAR(reproduced_share(0.0, 0.2), 0.8 + 0.2 * mutated_only, 0.03);
  EXPECT_NEAR(reproduced_share(0.8, 0.0), 0.2 + 0.8 * crossed_only, 0.03);
  EXPECT_NEAR(reproduced_share(0.8, 0.2), (0.2 + 0.8 * crossed_only) * (0.8 + 0.2 * mutated_only), 0.03);
}

}  // namespace
}  // namespace demecal
