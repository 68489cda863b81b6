// What jobs may ask of islands: limits, restarts, differing islands, whose place immigrants take.
#include <functional>
#include <limits>

#include "evolution/population.hpp"
#include "expression/bound.hpp"
#include "island_fixture.hpp"

namespace demecal {
namespace {

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

}  // namespace
}  // namespace demecal
