// A generation bred from the one before.
#include "evolution/breeding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "allocation_count.hpp"
#include "evolution/population.hpp"
#include "evolution/tree_generation.hpp"
#include "fitness/lessons.hpp"

namespace demecal {
namespace {

SharedPopulation first_population(RandomStream& random, const GpParameters& parameters, Breeder& breeder) {
  return breeder.enter(ramped_half_and_half(random, parameters, 1));
}

TEST(Tournament, PrefersTheFitterTheMoreTheLargerItIs) {
  std::vector<double> fitness(10);
  for (std::size_t i = 0; i < fitness.size(); ++i) fitness[i] = static_cast<double>((i * 7) % 10);
  RandomStream random{71};
  constexpr int kDraws = 20000;
  for (const int size : {1, 2, 5}) {
    int best = 0;
    for (int i = 0; i < kDraws; ++i) best += fitness[tournament(random, fitness, size)] == 0.0;
    const double expected = kDraws * (1.0 - std::pow(0.9, size));
    EXPECT_NEAR(best, expected, 4.0 * std::sqrt(expected));
  }
}

TEST(Tournament, FavoursNoPlaceAmongEquals) {
  const std::vector<double> fitness(10);
  RandomStream random{72};
  std::vector<int> wins(10);
  for (int i = 0; i < 20000; ++i) ++wins[tournament(random, fitness, 5)];
  for (const int count : wins) EXPECT_NEAR(count, 2000, 200);
}

TEST(Ranking, OrdersByFitnessThenIndex) {
  const std::vector<double> fitness{3.0, 1.0, 2.0, 1.0, INFINITY, 2.0};
  EXPECT_EQ(ranking(fitness), (std::vector<std::size_t>{1, 3, 2, 5, 0, 4}));
  EXPECT_EQ(fittest(fitness), 1u);
}

TEST(Breeding, HoldsNoFormulaTwiceWhereItMustNot) {
  GpParameters parameters = small_parameters();
  parameters.mutation_rate = 0.05;  // most offspring are copies otherwise
  parameters.crossover_rate = 0.3;
  const TrainingTable table = smooth_lesson();
  const auto most_duplicates = [&](bool none) {
    parameters.no_duplicates = none;
    RandomStream random{79};
    Breeder breeder(parameters, table);
    SharedPopulation population = first_population(random, parameters, breeder);
    std::size_t most = 0;
    for (int generation = 0; generation < 200; ++generation) {
      const double best = population.fitness[fittest(population.fitness)];
      breeder.breed(random, population);
      EXPECT_LE(population.fitness[fittest(population.fitness)], best);
      const std::set<NodeId> different(population.roots.begin(), population.roots.end());
      most = std::max(most, population.roots.size() - different.size());
    }
    return most;
  };
  EXPECT_EQ(most_duplicates(true), 0u);
  EXPECT_GT(most_duplicates(false), 20u);
}

TEST(Breeding, KeepsLimitsSizeTrueFitnessAndTheBest) {
  const GpParameters parameters = small_parameters();
  const TrainingTable table = smooth_lesson();
  for (const std::uint64_t seed : {1, 2, 3}) {
    RandomStream random{73, seed};
    Fitness fitness(table);
    Breeder breeder(parameters, table);
    SharedPopulation population = first_population(random, parameters, breeder);
    for (int generation = 0; generation < 40; ++generation) {
      const std::size_t best = fittest(population.fitness);
      const Tree best_tree = breeder.store().tree(population.roots[best]);
      const double best_fitness = population.fitness[best];
      ASSERT_LT(breeder.breed(random, population), 60u);
      ASSERT_EQ(population.roots.size(), 60u);
      ASSERT_EQ(breeder.store().tree(population.roots.front()), best_tree);
      ASSERT_EQ(population.fitness.front(), best_fitness);
      for (std::size_t i = 0; i < population.roots.size(); ++i) {
        const Tree tree = breeder.store().tree(population.roots[i]);
        ASSERT_TRUE(is_valid(tree, 1));
        ASSERT_LE(depth(tree), parameters.max_tree_depth);
        ASSERT_TRUE(depth(tree) >= parameters.min_tree_depth || tree == neutral_tree());
        ASSERT_EQ(population.fitness[i], fitness(tree));
      }
    }
  }
}

TEST(Breeding, GivesTheSameWhateverMemoryThereIsForColumns) {
  GpParameters parameters = small_parameters();
  parameters.functions.push_back(Primitive::absolute);
  const TrainingTable table = smooth_lesson(700);
  const auto bred = [&](std::size_t budget_bytes) {
    RandomStream random{76};
    Breeder breeder(parameters, table, budget_bytes);
    SharedPopulation population = first_population(random, parameters, breeder);
    std::vector<std::uint64_t> evaluations;
    for (int generation = 0; generation < 30; ++generation) evaluations.push_back(breeder.breed(random, population));
    std::vector<Tree> trees;
    for (const NodeId root : population.roots) trees.push_back(breeder.store().tree(root));
    return std::tuple(trees, population.fitness, evaluations);
  };
  const auto all_kept = bred(std::size_t{1} << 26);
  for (const std::size_t budget_bytes : {0, 700 * 8, 100'000}) EXPECT_TRUE(bred(budget_bytes) == all_kept);
}

TEST(Breeding, CountsOffspringThatEqualNoParentAndNoEarlierOffspring) {
  const GpParameters parameters = small_parameters();
  const TrainingTable table = smooth_lesson();
  RandomStream random{77};
  Breeder breeder(parameters, table);
  SharedPopulation population = first_population(random, parameters, breeder);
  for (int generation = 0; generation < 20; ++generation) {
    std::vector<Tree> known;
    for (const NodeId root : population.roots) known.push_back(breeder.store().tree(root));
    const std::uint64_t evaluations = breeder.breed(random, population);
    std::uint64_t expected = 0;
    for (const NodeId root : population.roots) {
      const Tree tree = breeder.store().tree(root);
      expected += std::find(known.begin(), known.end(), tree) == known.end();
      known.push_back(tree);
    }
    ASSERT_EQ(evaluations, expected);
  }
}

TEST(Breeding, CollectsWhatNoFormulaNeeds) {
  GpParameters parameters = small_parameters();
  parameters.population_size = 300;
  const TrainingTable table = smooth_lesson();
  RandomStream random{78};
  Breeder breeder(parameters, table);
  SharedPopulation population = first_population(random, parameters, breeder);
  std::size_t most = 0;
  for (int generation = 0; generation < 100; ++generation) {
    breeder.breed(random, population);
    most = std::max(most, breeder.store().size());
  }
  EXPECT_LT(most, breeder.store().functions_made() / 3);
}

TEST(Breeding, WithoutVariationReproducesParentsAndEvaluatesNothing) {
  GpParameters parameters = small_parameters();
  parameters.crossover_rate = parameters.mutation_rate = 0.0;
  const TrainingTable table = smooth_lesson();
  RandomStream random{74};
  Breeder breeder(parameters, table);
  SharedPopulation population = first_population(random, parameters, breeder);
  const SharedPopulation parents = population;
  EXPECT_EQ(breeder.breed(random, population), 0u);
  for (const NodeId root : population.roots)
    EXPECT_NE(std::find(parents.roots.begin(), parents.roots.end(), root), parents.roots.end());
}

TEST(Breeding, VariesAsManyAsItsTwoRatesSay) {
  GpParameters parameters = small_parameters();
  parameters.population_size = 2001;
  parameters.tournament_size = 1;
  const TrainingTable table = smooth_lesson(3);
  const auto reproduced_share = [&](double crossover_rate, double mutation_rate) {
    parameters.crossover_rate = crossover_rate;
    parameters.mutation_rate = mutation_rate;
    RandomStream random{75};
    Breeder breeder(parameters, table);
    SharedPopulation population = first_population(random, parameters, breeder);
    const std::set<NodeId> parents(population.roots.begin(), population.roots.end());
    breeder.breed(random, population);
    std::size_t reproduced = 0;
    for (const NodeId root : population.roots) reproduced += parents.count(root);
    return static_cast<double>(reproduced) / 2001.0;
  };
  const double crossed_only = reproduced_share(1.0, 0.0), mutated_only = reproduced_share(0.0, 1.0);
  EXPECT_LT(crossed_only, 0.15);  // equal terminals swapped
  EXPECT_LT(mutated_only, 0.15);  // a terminal for itself
  EXPECT_NEAR(reproduced_share(0.0, 0.2), 0.8 + 0.2 * mutated_only, 0.03);
  EXPECT_NEAR(reproduced_share(0.8, 0.0), 0.2 + 0.8 * crossed_only, 0.03);
  EXPECT_NEAR(reproduced_share(0.8, 0.2), (0.2 + 0.8 * crossed_only) * (0.8 + 0.2 * mutated_only), 0.03);
}

TEST(Breeding, AllocatesNothingOnceItIsWarm) {
  GpParameters parameters = small_parameters();
  parameters.population_size = 200;
  parameters.max_tree_nodes = 64;
  const TrainingTable table = smooth_lesson();
  RandomStream random{24};
  Breeder breeder(parameters, table);
  SharedPopulation population = breeder.enter(ramped_half_and_half(random, parameters, 1));
  for (int generation = 0; generation < 300; ++generation) breeder.breed(random, population);
  const std::uint64_t before = allocation_count();
  for (int generation = 0; generation < 50; ++generation) breeder.breed(random, population);
  const std::uint64_t after = allocation_count();
  const std::vector<double> allocated(100);
  EXPECT_EQ(allocation_count(), after + 1);
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace demecal
