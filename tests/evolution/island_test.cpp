// An island through its epochs: what it holds, how it learns, and that it can be moved at any epoch.
#include "evolution/island.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "evolution/selection.hpp"
#include "expression/limit.hpp"
#include "lessons.hpp"

namespace demecal {
namespace {

std::vector<double> fitness_of(const Population& population) {
  std::vector<double> fitness;
  for (const Individual& one : population) fitness.push_back(one.fitness);
  return fitness;
}

bool holds(const Population& population, const Tree& tree) {
  return std::any_of(population.begin(), population.end(), [&](const Individual& one) { return one.tree == tree; });
}

Archipelago pair_of_demes() {
  Archipelago archipelago;
  archipelago.joints = {0, 1};
  return archipelago;
}

class IslandTest : public testing::Test {
 protected:
  Island island(IslandKey key, std::uint64_t seed = 5) const {
    return Island(parameters, archipelago, table, key, seed);
  }
  Island finished(IslandKey key, std::uint64_t seed = 5) const {
    Island one = island(key, seed);
    while (!one.finished()) one.run_epoch({});
    return one;
  }

  GpParameters parameters = small_parameters();
  Archipelago archipelago = pair_of_demes();
  TrainingTable table = smooth_lesson();
};

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

// With everything on that an island decides by what it went through.
TEST_F(IslandTest, GoesOnElsewhereAsIfItHadStayedWithAllItsOptions) {
  table = lesson_with_a_pole();
  table.limit = 4.0;
  parameters.number_generations = 40;
  parameters.no_duplicates = true;
  parameters.restart_after = 1;
  parameters.function_weights = {1.0, 1.0, 2.0, 3.0, 1.0, 1.0, 0.5, 0.5};
  archipelago.migration_interval = 4;
  archipelago.replacement = Replacement::random;
  archipelago.spread = 0.5;
  const Population immigrants = finished({0, 1}).emigrants();
  for (const ConstantPolicy policy : {ConstantPolicy::none, ConstantPolicy::lamarckian, ConstantPolicy::baldwin}) {
    parameters.constants = policy;
    Island stayed = island({0, 0}), moved = island({0, 0});
    while (!stayed.finished()) {
      stayed.run_epoch(immigrants);
      Island next = island({0, 0});
      next.restore(moved.state());
      next.run_epoch(immigrants);
      moved.restore(next.state());
      ASSERT_TRUE(stayed.state() == moved.state()) << "after epoch " << stayed.state().epoch;
    }
  }
}

TEST_F(IslandTest, NeitherKeepsNorSendsWhatMayBreakTheLimit) {
  table = lesson_with_a_pole();
  const Interval range{-2.5, 2.5};
  const auto is_safe = [&](const Individual& one) { return stays_within(one.tree, range, 4.0); };
  int tempting = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    table.limit = std::numeric_limits<double>::infinity();
    const Population free = finished({0, 0}, seed).state().front;
    tempting += static_cast<int>(std::count_if(free.begin(), free.end(), std::not_fn(is_safe)));
    table.limit = 4.0;
    Island one = island({0, 0}, seed);
    while (!one.finished()) {
      one.run_epoch(free);
      const Population front = one.state().front, sent = one.emigrants();
      EXPECT_TRUE(std::all_of(front.begin(), front.end(), is_safe));
      EXPECT_TRUE(std::all_of(sent.begin(), sent.end(), is_safe));
      EXPECT_EQ(front.back().fitness, one.figures().best);
    }
  }
  EXPECT_GT(tempting, 5);
}

TEST_F(IslandTest, WithoutLimitsInReachIsAsWithoutLimits) {
  parameters.functions = {Primitive::add, Primitive::subtract, Primitive::sine, Primitive::cosine};
  table.limit = std::numeric_limits<double>::max();
  const Island limited = finished({0, 0});
  table.limit = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(limited.state() == finished({0, 0}).state());
}

TEST_F(IslandTest, BeginsAnewWhereNothingIsGained) {
  parameters.crossover_rate = parameters.mutation_rate = 0.0;  // nothing ever is
  parameters.number_generations = 100;
  parameters.restart_after = 2;
  Island one = island({0, 0});
  std::vector<std::uint32_t> begun_in;
  double best = std::numeric_limits<double>::infinity();
  while (!one.finished()) {
    const std::uint64_t before = one.state().evaluations;
    one.run_epoch({});
    if (one.state().evaluations - before == 60u) begun_in.push_back(one.state().epoch);
    EXPECT_LE(one.state().front.back().fitness, best);
    best = one.state().front.back().fitness;
  }
  EXPECT_EQ(begun_in, (std::vector<std::uint32_t>{1, 4, 6, 8, 10}));
}

TEST_F(IslandTest, ImmigrantsMayReplaceAnyButTheBest) {
  const Population sent = finished({0, 1}).emigrants();
  parameters.crossover_rate = parameters.mutation_rate = 0.0;
  archipelago.replacement = Replacement::random;
  std::size_t better_than_worst = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Island alone = island({0, 0}, seed), host = island({0, 0}, seed);
    alone.run_epoch({});
    host.run_epoch(sent);
    EXPECT_EQ(host.state().migrants_taken, sent.size());
    for (const Individual& one : sent) EXPECT_TRUE(holds(host.state().population, one.tree));
    EXPECT_TRUE(holds(host.state().population, alone.emigrants().front().tree));
    const std::vector<std::size_t> ranked = ranking(fitness_of(alone.state().population));
    std::size_t replaced = 0;
    for (std::size_t rank = 0; rank < ranked.size(); ++rank) {
      if (alone.state().population[ranked[rank]] == host.state().population[ranked[rank]]) continue;
      ++replaced;
      better_than_worst += rank + sent.size() < ranked.size();
    }
    EXPECT_EQ(replaced, sent.size());
  }
  EXPECT_GT(better_than_worst, 30u);
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
