// What fitted constants do to generations and islands: what is inherited, for how many, and that nobody else matters.
#include "evolution/breeding.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

#include "allocation_count.hpp"
#include "evolution/island.hpp"
#include "evolution/tree_generation.hpp"
#include "fitness/lessons.hpp"

namespace demecal {
namespace {

GpParameters learning(ConstantPolicy policy, double share = 1.0, bool scaling = false) {
  GpParameters parameters = small_parameters();
  parameters.constants = policy;
  parameters.constant_steps = 4;
  parameters.constant_share = share;
  parameters.linear_scaling = scaling;
  return parameters;
}

std::vector<Tree> first_trees(const GpParameters& parameters) {
  RandomStream random{91};
  return ramped_half_and_half(random, parameters, 1);
}

TEST(ConstantLearning, WithBaldwinLeavesTheGenotype) {
  const TrainingTable table = smooth_lesson();
  Fitness fitness(table);
  for (const ConstantPolicy policy : {ConstantPolicy::baldwin, ConstantPolicy::none}) {
    const GpParameters parameters = learning(policy, 1.0, true);
    const std::vector<Tree> trees = first_trees(parameters);
    Breeder breeder(parameters, table);
    const SharedPopulation population = breeder.enter(trees);
    int better = 0;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      ASSERT_EQ(breeder.store().tree(population.roots[i]), trees[i]);
      ASSERT_EQ(population.fitness[i], fitness(breeder.store().tree(population.models[i])));
      better += population.fitness[i] < fitness(trees[i]);
    }
    EXPECT_GT(better, 30);
  }
}

TEST(ConstantLearning, WithLamarckPassesOnWhatFitnessIsOf) {
  const GpParameters parameters = learning(ConstantPolicy::lamarckian, 0.5, true);
  const TrainingTable table = smooth_lesson();
  Fitness fitness(table);
  RandomStream random{92};
  Breeder breeder(parameters, table);
  SharedPopulation population = breeder.enter(first_trees(parameters));
  for (int generation = 0; generation < 30; ++generation) {
    breeder.breed(random, population);
    EXPECT_EQ(population.models, population.roots);
    for (std::size_t i = 0; i < population.roots.size(); ++i)
      ASSERT_EQ(population.fitness[i], fitness(breeder.store().tree(population.roots[i])));
  }
}

TEST(ConstantLearning, KeepsItsShare) {
  const TrainingTable table = smooth_lesson();
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    const GpParameters parameters = learning(ConstantPolicy::lamarckian, share);
    RandomStream random{93};
    Breeder breeder(parameters, table);
    SharedPopulation population = breeder.enter(first_trees(parameters));
    for (std::uint64_t generation = 1; generation < 20; ++generation) {
      breeder.breed(random, population);
      EXPECT_LE(static_cast<double>(breeder.learning().fits()), static_cast<double>(generation + 1) * share * 60.0);
    }
    EXPECT_EQ(breeder.learning().fits() > 0, share > 0.0);
  }
}

TEST(ConstantLearning, FitsTheFittest) {
  const TrainingTable table = smooth_lesson();
  const GpParameters few = learning(ConstantPolicy::baldwin, 0.2);
  const std::vector<Tree> trees = first_trees(few);
  Fitness fitness(table);
  Breeder breeder(few, table);
  const SharedPopulation population = breeder.enter(trees);
  double worst_fitted = 0.0;
  std::size_t better = 0, as_good = 0;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    if (population.fitness[i] == fitness(trees[i])) continue;
    worst_fitted = std::max(worst_fitted, fitness(trees[i]));
    ++better;
  }
  for (const Tree& tree : trees) as_good += fitness(tree) <= worst_fitted ? 1 : 0;
  EXPECT_GT(better, 3u);
  EXPECT_LE(as_good, 12u);
}

TEST(ConstantLearning, AllocatesNextToNothingOnceItIsWarm) {
  GpParameters parameters = learning(ConstantPolicy::lamarckian, 0.5, true);
  parameters.max_tree_nodes = 64;
  const TrainingTable table = smooth_lesson();
  RandomStream random{94};
  Breeder breeder(parameters, table);
  SharedPopulation population = breeder.enter(first_trees(parameters));
  for (int generation = 0; generation < 300; ++generation) breeder.breed(random, population);
  const std::uint64_t before = allocation_count();
  for (int generation = 0; generation < 50; ++generation) breeder.breed(random, population);
  EXPECT_LE(allocation_count(), before + 3) << "in 3000 offspring";
}

struct Way {
  ConstantPolicy policy;
  double share;
  bool scaling;
};

class LearningIsland : public testing::TestWithParam<Way> {
 protected:
  LearningIsland() { archipelago.joints = {0, 1}; }
  Island island(IslandKey key) const { return Island(parameters, archipelago, table, key, 5); }
  Island finished(IslandKey key) const {
    Island one = island(key);
    while (!one.finished()) one.run_epoch({});
    return one;
  }

  GpParameters parameters = learning(GetParam().policy, GetParam().share, GetParam().scaling);
  Archipelago archipelago;
  TrainingTable table = smooth_lesson();
};

TEST_P(LearningIsland, GoesOnElsewhereAsIfItHadStayed) {
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

TEST_P(LearningIsland, HasAFrontOfTrueFitnessWithinLimits) {
  parameters.max_tree_nodes = 64;
  const Island one = finished({0, 0});
  Fitness fitness(table);
  ASSERT_FALSE(one.state().front.empty());
  for (const Individual& member : one.state().front) {
    EXPECT_EQ(member.fitness, fitness(member.tree));
    EXPECT_LE(depth(member.tree), parameters.max_tree_depth);
    EXPECT_LE(member.tree.size(), 64u);
  }
  EXPECT_EQ(one.state().front.back().fitness, one.figures().best);
}

TEST_P(LearningIsland, DoesBetterThanOneThatDoesNotLearn) {
  const double learnt = finished({0, 0}).figures().best;
  parameters.constants = ConstantPolicy::none;
  parameters.linear_scaling = false;
  EXPECT_LT(learnt, finished({0, 0}).figures().best);
}

std::uint64_t bits_of(const Population& population) {
  std::uint64_t bits = 0;
  const auto add = [&bits](double number) { bits = (bits ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3; };
  for (const Individual& individual : population) {
    for (const Node& node : individual.tree) add(node.primitive == Primitive::constant ? node.value : 0.0);
    add(individual.fitness);
  }
  return bits;
}

// Written down once; what it was does not matter, but that vector units of every width, and none, give it.
TEST(ConstantLearning, GivesTheSameBitsOnEveryHost) {
  for (const auto& [policy, bits] : {std::pair{ConstantPolicy::lamarckian, std::uint64_t{16613584369645031142U}},
                                     std::pair{ConstantPolicy::baldwin, std::uint64_t{5043647133263849937U}}}) {
    const GpParameters parameters = learning(policy, 0.5, true);
    Archipelago archipelago;
    archipelago.joints = {0};
    RandomStream random{95};
    TrainingTable table = two_variable_lesson(random, 300);
    Island island(parameters, archipelago, table, {0, 0}, 5);
    while (!island.finished()) island.run_epoch({});
    EXPECT_EQ(bits_of(island.state().population), bits);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, LearningIsland,
                         testing::Values(Way{ConstantPolicy::lamarckian, 1.0, false},
                                         Way{ConstantPolicy::lamarckian, 0.2, true},
                                         Way{ConstantPolicy::baldwin, 1.0, false},
                                         Way{ConstantPolicy::baldwin, 0.2, true},
                                         Way{ConstantPolicy::none, 1.0, true}));

}  // namespace
}  // namespace demecal
