// Messages about islands as received: all that islands really say is accepted, what contradicts the run is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "protocol/faults.hpp"
#include "small_run.hpp"

namespace demecal {
namespace {

const CalibrationData& run() {
  static const CalibrationData data = small_run();
  return data;
}

template <class Plain>
struct Spoiling {
  const char* what;
  std::function<void(Plain&)> spoil;
};

/// Each spoiling of a sound message is found, and the sound one has no fault.
template <class Plain>
void expect_found(const Plain& sound, const std::vector<Spoiling<Plain>>& spoilings) {
  EXPECT_EQ(find_fault(sound, run()), std::nullopt);
  for (const auto& [what, spoil] : spoilings) {
    Plain spoilt = sound;
    spoil(spoilt);
    EXPECT_NE(find_fault(spoilt, run()), std::nullopt) << what;
  }
}

template <class Plain>
std::vector<Spoiling<Plain>> wrong_islands() {
  return {{"another run", [](Plain& m) { m.run += 1; }},
          {"a joint outside the run", [](Plain& m) { m.island.joint = 1; }},
          {"a joint beyond all", [](Plain& m) { m.island.joint = 4'000'000'000; }},
          {"a deme outside the run", [](Plain& m) { m.island.deme = 2; }}};
}

const Tree kUnfinished{{Primitive::add}, {Primitive::variable}};

Tree too_deep() {
  Tree tree = variable_tree(0);
  for (int i = 0; i <= run().parameters.max_tree_depth; ++i) tree = apply(Primitive::sine, tree);
  return tree;
}

IslandTask task_after(std::uint32_t epochs) {
  const Checkpoint checkpoint = checkpoint_after(run(), epochs);
  return {checkpoint.run, checkpoint.island, 3, "a worker", checkpoint.state, checkpoint.recent};
}

Outcome outcome() {
  const Checkpoint checkpoint = checkpoint_after(run(), kEpochsOfSmallRun);
  return {checkpoint.run,
          1,
          checkpoint.island,
          "a worker",
          checkpoint.state.generation,
          checkpoint.state.evaluations,
          0,
          checkpoint.state.front};
}

TEST(IslandFaults, WhatAnIslandSaysAfterAnyEpochHasNone) {
  for (std::uint32_t epochs = 0; epochs <= kEpochsOfSmallRun; ++epochs) {
    EXPECT_EQ(find_fault(checkpoint_after(run(), epochs), run()), std::nullopt) << epochs;
    EXPECT_EQ(find_fault(task_after(epochs), run()), std::nullopt) << epochs;
  }
}

TEST(IslandFaults, EverySpoiltFieldOfMigrantsIsFound) {
  auto spoilings = wrong_islands<Migrants>();
  spoilings.insert(spoilings.end(),
                   {{"epoch 0", [](auto& m) { m.epoch = 0; }},
                    {"an epoch after the last", [](auto& m) { m.epoch = kEpochsOfSmallRun + 1; }},
                    {"more than agreed", [](auto& m) { m.individuals.resize(4, m.individuals.front()); }},
                    {"an unfinished tree", [](auto& m) { m.individuals[0].tree = kUnfinished; }},
                    {"an empty tree", [](auto& m) { m.individuals[0].tree.clear(); }},
                    {"an unknown variable", [](auto& m) { m.individuals[0].tree = variable_tree(1); }},
                    {"an infinite constant",
                     [](auto& m) {
                       m.individuals[0].tree = {{Primitive::constant, 0, HUGE_VAL}};
                     }},
                    {"a tree too deep", [](auto& m) { m.individuals[0].tree = too_deep(); }},
                    {"a fitness below 0", [](auto& m) { m.individuals[0].fitness = -1.0; }},
                    {"a fitness that is no number", [](auto& m) { m.individuals[0].fitness = std::nan(""); }}});
  expect_found(checkpoint_after(run(), 2).recent.back(), spoilings);
}

TEST(IslandFaults, EverySpoiltFieldOfACheckpointIsFound) {
  auto spoilings = wrong_islands<Checkpoint>();
  spoilings.insert(spoilings.end(),
                   {{"an epoch after the last", [](auto& m) { m.state.epoch = 99; }},
                    {"generations that were not bred", [](auto& m) { ++m.state.generation; }},
                    {"an individual too few", [](auto& m) { m.state.population.pop_back(); }},
                    {"an unfinished tree", [](auto& m) { m.state.population[3].tree = kUnfinished; }},
                    {"a front that does not fall", [](auto& m) { m.state.front.push_back(m.state.front.back()); }},
                    {"a front of infinite fitness", [](auto& m) { m.state.front.front().fitness = HUGE_VAL; }},
                    {"emigrants of another island", [](auto& m) { m.recent[0].island.deme = 0; }},
                    {"emigrants of another run", [](auto& m) { m.recent[0].run = 1; }},
                    {"emigrants in disorder", [](auto& m) { std::swap(m.recent[0], m.recent[1]); }},
                    {"emigrants of the future", [](auto& m) { m.recent.back().epoch = m.state.epoch + 1; }},
                    {"too many emigrations", [](auto& m) { m.recent.resize(kMigrantEpochs + 1, m.recent.back()); }}});
  expect_found(checkpoint_after(run(), 3), spoilings);
}

TEST(IslandFaults, EverySpoiltFieldOfATaskIsFound) {
  auto spoilings = wrong_islands<IslandTask>();
  spoilings.insert(spoilings.end(), {{"nobody's", [](auto& m) { m.worker.clear(); }},
                                     {"attempt 0", [](auto& m) { m.attempt = 0; }},
                                     {"a population before the first epoch", [](auto& m) { m.start.epoch = 0; }},
                                     {"no population after it", [](auto& m) { m.start.population.clear(); }},
                                     {"emigrants of the future", [](auto& m) { m.recent.back().epoch += 1; }}});
  expect_found(task_after(2), spoilings);
}

TEST(IslandFaults, EverySpoiltFieldOfAnOutcomeIsFound) {
  auto spoilings = wrong_islands<Outcome>();
  spoilings.insert(spoilings.end(), {{"nobody's", [](auto& m) { m.worker.clear(); }},
                                     {"unfinished", [](auto& m) { m.generations -= 1; }},
                                     {"an unfinished tree", [](auto& m) { m.front[0].tree = kUnfinished; }}});
  expect_found(outcome(), spoilings);
}

TEST(IslandFaults, EverySpoiltFieldOfProgressIsFound) {
  auto spoilings = wrong_islands<Progress>();
  spoilings.insert(spoilings.end(), {{"nobody's", [](auto& m) { m.worker.clear(); }},
                                     {"an epoch after the last", [](auto& m) { m.epoch = kEpochsOfSmallRun + 1; }},
                                     {"a generation after the last", [](auto& m) { m.generation = 8; }},
                                     {"a best that is no number", [](auto& m) { m.figures.best = std::nan(""); }},
                                     {"a median below 0", [](auto& m) { m.figures.median = -1.0; }},
                                     {"a diversity above 1", [](auto& m) { m.figures.diversity = 1.5; }},
                                     {"a share that is no number", [](auto& m) { m.waited_share = std::nan(""); }},
                                     {"a speed without end", [](auto& m) { m.evaluations_per_s = HUGE_VAL; }}});
  Progress progress;
  progress.run = run().run;
  progress.island = kSomeIsland;
  progress.worker = "a worker";
  progress.epoch = kEpochsOfSmallRun;
  progress.generation = 7;
  expect_found(progress, spoilings);
}

TEST(IslandFaults, AWorkerNeedsANameAndASlot) {
  WorkerStatus status;
  EXPECT_NE(find_fault(status), std::nullopt);
  status.worker = "a worker";
  EXPECT_EQ(find_fault(status), std::nullopt);
  for (const std::uint32_t slots : {0U, kMostSlots + 1}) {
    status.slots = slots;
    EXPECT_NE(find_fault(status), std::nullopt);
  }
  status.slots = 1;
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    status.waited_share = share;
    EXPECT_NE(find_fault(status), std::nullopt);
  }
}

TEST(IslandFaults, ATreeWithMoreNodesThanAllowedIsFound) {
  GpParameters parameters = run().parameters;
  const Tree tree = apply(Primitive::add, variable_tree(0), variable_tree(0));
  parameters.max_tree_nodes = 3;
  EXPECT_EQ(find_fault(Population{{tree, 1.0}}, parameters, 1), std::nullopt);
  parameters.max_tree_nodes = 2;
  EXPECT_NE(find_fault(Population{{tree, 1.0}}, parameters, 1), std::nullopt);
}

TEST(IslandFaults, AnInfiniteFitnessIsAllowedInAPopulation) {
  EXPECT_EQ(find_fault(Population{{variable_tree(0), HUGE_VAL}}, run().parameters, 1), std::nullopt);
}

}  // namespace
}  // namespace demecal
