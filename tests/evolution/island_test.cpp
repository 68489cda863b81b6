// An island through its epochs: what it holds, how it learns, and that it can be moved at any epoch.
#include "evolution/island.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "evolution/population.hpp"
#include "island_fixture.hpp"

namespace demecal {
namespace {

TEST_F(IslandTest, BeginsWithAPopulationThatHoldsTheNeutralModel) {
  Island one = island({0, 0});
  one.run_epoch({});
  EXPECT_EQ(one.state().epoch, 1u);
  EXPECT_EQ(one.state().generation, 0u);
  EXPECT_EQ(one.state().evaluations, 60u);
  EXPECT_TRUE(holds(one.state().population, neutral_tree()));
}

TEST_F(IslandTest, BeginsWithTheTablesSeedsThatFitItsLimits) {
  const Tree sine = apply(Primitive::sine, variable_tree(0)), foreign = apply(Primitive::sine, variable_tree(1));
  table.seeds = {sine, foreign};
  Island one = island({0, 0});
  one.run_epoch({});
  EXPECT_TRUE(holds(one.state().population, sine));
  EXPECT_FALSE(holds(one.state().population, foreign));
  EXPECT_TRUE(holds(one.state().population, neutral_tree()));
  EXPECT_EQ(one.state().population.size(), 60u);
}

TEST_F(IslandTest, BreedsExactlyItsGenerations) {
  Island one = island({0, 0});
  std::vector<std::uint32_t> generations;
  while (!one.finished()) {
    one.run_epoch({});
    generations.push_back(one.state().generation);
  }
  EXPECT_EQ(generations, (std::vector<std::uint32_t>{0, 10, 20, 24}));
  EXPECT_EQ(one.epochs_total(), 4u);
  EXPECT_EQ(one.state().epoch, 4u);
}

TEST_F(IslandTest, TellsOfEveryGeneration) {
  Island one = island({0, 0});
  std::uint32_t told = 0;
  while (!one.finished()) {
    one.run_epoch({}, [&] { ++told; });
    EXPECT_EQ(told, one.state().generation);
  }
}

TEST_F(IslandTest, IsAFunctionOfSeedAndKey) {
  const Island one = finished({1, 1}), two = finished({1, 1});
  EXPECT_TRUE(one.state() == two.state());
  EXPECT_FALSE(one.state() == finished({1, 1}, 6).state());
  EXPECT_FALSE(one.state() == finished({1, 0}).state());
  EXPECT_FALSE(one.state() == finished({0, 1}).state());
}

TEST_F(IslandTest, GoesOnElsewhereAsIfItHadStayed) {
  const Population immigrants = finished({0, 1}).emigrants();
  for (std::uint32_t stop = 0; stop < 4; ++stop) {
    Island stayed = island({0, 0}), left = island({0, 0});
    while (left.state().epoch < stop) left.run_epoch(immigrants);
    Island moved = island({0, 0});
    moved.restore(left.state());
    while (!stayed.finished()) stayed.run_epoch(immigrants);
    while (!moved.finished()) moved.run_epoch(immigrants);
    EXPECT_TRUE(stayed.state() == moved.state()) << "moved after epoch " << stop;
  }
}

TEST_F(IslandTest, NeverLosesItsBest) {
  Island one = island({0, 0});
  double best = INFINITY;
  while (!one.finished()) {
    one.run_epoch({});
    EXPECT_LE(one.figures().best, best);
    best = one.figures().best;
    EXPECT_EQ(one.state().front.back().fitness, best);
  }
}

TEST_F(IslandTest, ShowsFiguresOfItsPopulation) {
  const Island one = finished({0, 0});
  const Population& population = one.state().population;
  const IslandFigures figures = one.figures();
  std::vector<double> values;
  for (const Individual& individual : population) values.push_back(individual.fitness);
  std::sort(values.begin(), values.end());
  EXPECT_EQ(figures.best, values.front());
  EXPECT_EQ(figures.median, values[29]);
  EXPECT_EQ(figures.best_length, population[fittest(fitness_of(population))].tree.size());
}

TEST_F(IslandTest, DiversityIsTheShareOfDifferentTrees) {
  Island one = finished({0, 0});
  IslandState state = one.state();
  std::size_t different = 0;
  for (std::size_t i = 0; i < state.population.size(); ++i) {
    const auto same = [&](const Individual& other) { return other.tree == state.population[i].tree; };
    different +=
        std::none_of(state.population.begin(), state.population.begin() + static_cast<std::ptrdiff_t>(i), same);
  }
  EXPECT_EQ(one.figures().diversity, static_cast<double>(different) / static_cast<double>(state.population.size()));
  EXPECT_GT(different, 1u);
  state.population.assign(state.population.size(), state.population.front());
  one.restore(state);
  EXPECT_EQ(one.figures().diversity, 1.0 / static_cast<double>(state.population.size()));
}

TEST_F(IslandTest, SendsItsBestEachOnce) {
  archipelago.migrants = 5;
  const Island one = finished({0, 0});
  const Population sent = one.emigrants();
  ASSERT_EQ(sent.size(), 5u);
  EXPECT_EQ(sent.front().fitness, one.figures().best);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_TRUE(i == 0 || sent[i - 1].fitness <= sent[i].fitness);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(sent[i].tree, sent[j].tree);
  }
  for (const Individual& individual : one.state().population)
    EXPECT_TRUE(holds(sent, individual.tree) || individual.fitness >= sent.back().fitness);
}

TEST_F(IslandTest, TakesInWhatWasSentInThePlaceOfTheWorst) {
  const Population sent = finished({0, 1}).emigrants();
  parameters.crossover_rate = parameters.mutation_rate = 0.0;
  Island alone = island({0, 0}), host = island({0, 0});
  alone.run_epoch({});
  host.run_epoch(sent);
  EXPECT_EQ(host.state().migrants_taken, sent.size());
  EXPECT_EQ(host.state().evaluations, alone.state().evaluations + sent.size());
  for (const Individual& one : sent) EXPECT_TRUE(holds(host.state().population, one.tree));
  const std::vector<std::size_t> ranked = ranking(fitness_of(alone.state().population));
  for (std::size_t rank = 0; rank < ranked.size(); ++rank) {
    const std::size_t i = ranked[rank];
    EXPECT_EQ(alone.state().population[i] == host.state().population[i], rank + sent.size() < ranked.size());
  }
}

TEST_F(IslandTest, JudgesImmigrantsByItsOwnTable) {
  const Population sent = finished({0, 1}).emigrants();
  table = smooth_lesson(30, 2.0);
  Island host = island({1, 0});
  host.run_epoch(sent);
  Fitness fitness(table);
  for (const Individual& one : host.state().population) EXPECT_EQ(one.fitness, fitness(one.tree));
  EXPECT_EQ(host.state().migrants_taken, sent.size());
}

TEST_F(IslandTest, TakesInNoTreeTwice) {
  Population sent = finished({0, 1}).emigrants();
  const std::size_t distinct = sent.size();
  sent.insert(sent.end(), sent.begin(), sent.end());
  sent.push_back({neutral_tree(), 0.0});
  Island host = island({0, 0});
  host.run_epoch(sent);
  EXPECT_EQ(host.state().migrants_taken, distinct);
}

TEST_F(IslandTest, LeavesOutImmigrantsThatDoNotFit) {
  Tree deep = variable_tree(0);
  for (int i = 0; i < 10; ++i) deep = apply(Primitive::sine, deep);
  const Tree foreign = apply(Primitive::sine, variable_tree(1));
  const Tree broken{{Primitive::add, 0, 0.0}, {Primitive::variable, 0, 0.0}};
  Island host = island({0, 0});
  host.run_epoch({{deep, 0.0}, {foreign, 0.0}, {broken, 0.0}, {{}, 0.0}});
  EXPECT_EQ(host.state().migrants_taken, 0u);
}

TEST_F(IslandTest, KeepsToItsLimitOfNodes) {
  Tree large = neutral_tree();
  for (int i = 0; i < 5; ++i) large = apply(Primitive::add, large, large);
  parameters.max_tree_nodes = 63;
  Island one = island({0, 0});
  while (!one.finished()) {
    one.run_epoch({{large, 0.0}});
    for (const Individual& individual : one.state().population) ASSERT_LE(individual.tree.size(), 63u);
  }
  EXPECT_EQ(one.state().migrants_taken, 0u);
}

TEST_F(IslandTest, NeverLosesItsBestToImmigrants) {
  Population flood;
  for (int i = 0; i < 200; ++i) flood.push_back({apply(Primitive::sine, constant_tree(100.0 + i)), 0.0});
  Island alone = island({0, 0}), host = island({0, 0});
  alone.run_epoch({});
  host.run_epoch(flood);
  EXPECT_EQ(host.state().migrants_taken, 59u);
  EXPECT_LE(host.figures().best, alone.figures().best);
  EXPECT_TRUE(holds(host.state().population, alone.emigrants().front().tree));
}

TEST_F(IslandTest, LearnsASmoothCorrection) {
  parameters = GpParameters{};
  parameters.number_generations = 50;
  const double neutral = Fitness(table)(neutral_tree());
  for (const std::uint64_t seed : {1, 2, 3}) EXPECT_LT(finished({0, 0}, seed).figures().best, 0.25 * neutral);
}

TEST_F(IslandTest, LivesWithOneIndividual) {
  parameters.population_size = parameters.tournament_size = 1;
  const Island one = finished({0, 0});
  ASSERT_EQ(one.state().population.size(), 1u);
  EXPECT_EQ(one.state().population.front().tree, neutral_tree());
}

}  // namespace
}  // namespace demecal
