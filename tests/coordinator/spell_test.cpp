// What a slot breeds at one go is what it would breed an epoch at a time.
#include "worker/spell.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "in_memory_run.hpp"

namespace demecal {
namespace {

using Tenancies = std::map<IslandKey, std::shared_ptr<Tenancy>>;

constexpr auto kLong = std::chrono::hours(1);

CalibrationData busy_run(int generations = 30, bool between_joints = false) {
  CalibrationData data = small_run(31, Topology::ring, between_joints);
  data.parameters.number_generations = generations;
  return data;
}

Tenancies tenancies_of(const CalibrationData& data) {
  const auto run = std::make_shared<RunData>(RunData{data});
  Tenancies tenancies;
  for (const IslandKey& island : islands(data.archipelago)) {
    tenancies[island] = std::make_shared<Tenancy>(
        run,
        IslandTask{.run = data.run, .island = island, .attempt = 1, .worker = "worker", .start = {}, .recent = {}});
  }
  return tenancies;
}

std::vector<Spell::Member> members_of(const Tenancies& tenancies) {
  std::vector<Spell::Member> members;
  for (const auto& [island, tenancy] : tenancies) members.push_back({tenancy, false});
  return members;
}

TEST(Spell, BreedsToTheBitWhatIslandsBreedInStep) {
  const CalibrationData data = busy_run();
  const Tenancies together = tenancies_of(data), in_step = tenancies_of(data);
  Spell(members_of(together), {}).breed(kLong, [] {});
  MigrantStore store;
  while (!in_step.begin()->second->finished()) {
    for (const auto& [island, tenancy] : in_step) tenancy->run_epoch(tenancy->immigrants(store), [] {});
    for (const auto& [island, tenancy] : in_step) store.put(tenancy->last_migrants());
  }
  for (const auto& [island, tenancy] : together) {
    EXPECT_TRUE(tenancy->finished());
    EXPECT_EQ(tenancy->outcome("worker"), in_step.at(island)->outcome("worker"));
  }
}

TEST(Spell, EndsAfterAnEpochOfAnIslandThatAnotherWorkerWaitsFor) {
  for (std::size_t awaited = 0; awaited < 6; ++awaited) {
    const Tenancies tenancies = tenancies_of(busy_run());
    std::vector<Spell::Member> members = members_of(tenancies);
    members[awaited].is_awaited = true;
    Spell(members, {}).breed(kLong, [] {});
    EXPECT_EQ(members[awaited].tenancy->epoch(), 1U);
  }
}

TEST(Spell, EndsWhenItsTimeIsOverOrItIsToldTo) {
  const auto epochs_of = [](const Tenancies& tenancies) {
    std::uint32_t epochs = 0;
    for (const auto& [island, tenancy] : tenancies) epochs += tenancy->epoch();
    return epochs;
  };
  const Tenancies timed = tenancies_of(busy_run()), told = tenancies_of(busy_run());
  Spell(members_of(timed), {}).breed(kAtOnce, [] {});
  EXPECT_EQ(epochs_of(timed), 1U);
  Spell spell(members_of(told), {});
  spell.end_soon();
  spell.breed(kLong, [] {});
  EXPECT_EQ(epochs_of(told), 1U);
}

TEST(Spell, EndsBeforeNeighboursForgetWhatAnIslandSent) {
  const Tenancies tenancies = tenancies_of(busy_run(3 * kMigrantEpochs));
  Spell(members_of(tenancies), {}).breed(kLong, [] {});
  for (const auto& [island, tenancy] : tenancies) {
    EXPECT_GT(tenancy->epoch(), 1U);
    EXPECT_LE(tenancy->epoch(), std::uint32_t{kMigrantEpochs / 4});
  }
}

TEST(Spell, EndsWhereAnIslandLacksMigrantsAndGoesOnWithThoseThatCame) {
  const CalibrationData data = busy_run();
  const Tenancies all = tenancies_of(data);
  const std::shared_ptr<Tenancy> alone = all.begin()->second;
  Spell({{alone, false}}, {}).breed(kLong, [] {});
  ASSERT_EQ(alone->epoch(), 1U);
  MigrantStore arrived;
  for (const IslandKey& source : alone->sources()) {
    all.at(source)->run_epoch({}, [] {});
    arrived.put(all.at(source)->last_migrants());
  }
  MigrantStore theirs;
  theirs.copy(arrived, alone->sources(), alone->epoch());
  Spell({{alone, false}}, theirs).breed(kLong, [] {});
  EXPECT_EQ(alone->epoch(), 2U);
}

TEST(Spell, LinksThoseThatExchangeMigrants) {
  const auto linked = [](const Tenancies& tenancies) {
    return linked_with(tenancies.begin()->second, tenancies).size();
  };
  EXPECT_EQ(linked(tenancies_of(busy_run())), 3U);
  EXPECT_EQ(linked(tenancies_of(busy_run(30, true))), 6U);
  Tenancies some = tenancies_of(busy_run());
  std::erase_if(some, [](const auto& entry) { return entry.first.joint == 0 && entry.first.deme == 1; });
  EXPECT_EQ(linked(some), 2U);
}

}  // namespace
}  // namespace demecal
