// Runs that breed sets of effects, as received: what islands really say is accepted, what cannot be is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../effect_sets/deceptive.hpp"
#include "effect_sets/set_island.hpp"
#include "protocol/faults.hpp"
#include "small_run.hpp"

namespace demecal {
namespace {

const SetSearch kSearch{.known = {1, 2, 7}, .search = {.variations = 100}, .stream = 3};

CalibrationData set_run() {
  CalibrationData data = data_of_search(deceptive(41), kSearch);
  data.run = 7;
  return data;
}

Checkpoint checkpoint() {
  const ExplanationProblem problem = deceptive(41);
  SetIsland island(problem, kSearch, {0, 2});
  Checkpoint checkpoint{.run = 7, .attempt = 1, .island = {0, 2}, .state = {}, .recent = {}};
  for (int i = 0; i < 4; ++i) {
    island.run_epoch({});
    checkpoint.recent.push_back({7, {0, 2}, island.state().epoch, island.emigrants()});
  }
  checkpoint.state = island.state();
  return checkpoint;
}

TEST(SetFaults, WhatIslandsSayHasNone) {
  EXPECT_EQ(find_fault(set_run()), std::nullopt);
  EXPECT_EQ(find_fault(checkpoint(), set_run()), std::nullopt);
}

TEST(SetFaults, EverySpoiltFieldOfTheDataIsFound) {
  using Spoil = std::function<void(CalibrationData&)>;
  const std::vector<std::pair<const char*, Spoil>> spoilings{
      {"formulas where sets stand", [](auto& d) { d.breeds = Breeds::formulas; }},
      {"tables as well", [](auto& d) { d.tables = small_run().tables; }},
      {"no effects", [](auto& d) { d.sets.columns.clear(); }},
      {"a product too few", [](auto& d) { d.sets.gram.pop_back(); }},
      {"a product that is no number", [](auto& d) { d.sets.gram[5] = std::nan(""); }},
      {"an infinite moment", [](auto& d) { d.sets.moment[3] = HUGE_VAL; }},
      {"an effect of more columns than there are", [](auto& d) { d.sets.columns[0] = 4'000'000'000; }},
      {"columns of no effect", [](auto& d) { d.sets.columns[0] = 0; }},
      {"a price too few", [](auto& d) { d.sets.naming_costs_nats.pop_back(); }},
      {"a cause without a name", [](auto& d) { d.sets.causes[1] = 10; }},
      {"more names than effects", [](auto& d) { d.sets.cause_names.resize(41); }},
      {"a first set twice the same",
       [](auto& d) {
         d.sets.known = {4, 4};
       }},
      {"a first set of what there is not", [](auto& d) { d.sets.known = {40}; }},
      {"no squares", [](auto& d) { d.sets.squares = 0.0; }},
      {"no rows", [](auto& d) { d.sets.rows = std::nan(""); }},
      {"no poses", [](auto& d) { d.sets.poses = 0.0; }},
      {"more freedom than rows", [](auto& d) { d.sets.freedom = 1e9; }},
      {"fewer variations than none", [](auto& d) { d.sets.variations = -1; }},
      {"more variations than the limit", [](auto& d) { d.sets.variations = kMostVariations + 1; }},
      {"more effects than the limit", [](auto& d) { d.sets.most_effects = kMostSetEffects + 1; }},
      {"more causes than the limit", [](auto& d) { d.sets.most_causes = kMostSetEffects + 1; }},
      {"more than all freedom", [](auto& d) { d.sets.most_freedom = 1.5; }},
      {"islands of another joint", [](auto& d) { d.archipelago.joints = {1}; }},
      {"an island more", [](auto& d) { d.archipelago.demes_per_joint = 5; }},
      {"no ring", [](auto& d) { d.archipelago.topology = Topology::full; }},
      {"a generation more", [](auto& d) { d.parameters.number_generations = 10; }},
      {"other numbers of migrants", [](auto& d) { d.archipelago.migrants = 3; }},
      {"islands that wait for nobody", [](auto& d) { d.archipelago.asynchronous = true; }},
  };
  for (const auto& [what, spoil] : spoilings) {
    CalibrationData data = set_run();
    spoil(data);
    EXPECT_NE(find_fault(data), std::nullopt) << what;
  }
}

TEST(SetFaults, EverySpoiltFieldOfAnIslandIsFound) {
  using Spoil = std::function<void(Checkpoint&)>;
  const Tree formula{{Primitive::variable}};
  const std::vector<std::pair<const char*, Spoil>> spoilings{
      {"a formula", [&](auto& c) { c.state.population[1].tree = formula; }},
      {"an effect that there is not", [](auto& c) { c.state.population[1].effects = {40}; }},
      {"an effect twice",
       [](auto& c) {
         c.state.population[1].effects = {3, 3};
       }},
      {"a fitness below 0", [](auto& c) { c.state.population[1].fitness = -1.0; }},
      {"nothing kept", [](auto& c) { c.state.population.clear(); }},
      {"more kept than can be", [](auto& c) { c.state.population.resize(45, c.state.population[0]); }},
      {"a front of more than all numbers of causes", [](auto& c) { c.state.front.resize(12, c.state.front[0]); }},
      {"generations that do not agree with epochs", [](auto& c) { c.state.generation = 4; }},
      {"more epochs than there are", [](auto& c) { c.state.epoch = kSetEpochs + 1; }},
      {"more random numbers than anybody draws", [](auto& c) { c.state.draws = ~std::uint64_t{0}; }},
      {"migrants that are formulas", [&](auto& c) { c.recent[0].individuals[0].tree = formula; }},
      {"more migrants than agreed", [](auto& c) { c.recent[0].individuals.resize(12, c.recent[0].individuals[0]); }},
  };
  for (const auto& [what, spoil] : spoilings) {
    Checkpoint spoilt = checkpoint();
    spoil(spoilt);
    EXPECT_NE(find_fault(spoilt, set_run()), std::nullopt) << what;
  }
}

TEST(SetFaults, SetsAreNoFormulas) {
  const CalibrationData data = small_run();
  Checkpoint checkpoint = checkpoint_after(data, 2);
  EXPECT_EQ(find_fault(checkpoint, data), std::nullopt);
  checkpoint.state.population[0].effects = {1};
  EXPECT_NE(find_fault(checkpoint, data), std::nullopt);
}

}  // namespace
}  // namespace demecal
