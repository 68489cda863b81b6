// What a slot breeds at one go is what it would breed an epoch at a time.
#include "hosting/island_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scheduling/in_memory_run.hpp"

namespace demecal {
namespace {

using HostedIslands = std::map<IslandKey, std::shared_ptr<HostedIsland>>;

constexpr auto kLong = std::chrono::hours(1);

CalibrationData busy_run(int generations = 30, bool between_joints = false) {
  CalibrationData data = small_run(31, Topology::ring, between_joints);
  data.parameters.number_generations = generations;
  return data;
}

HostedIslands hosted_islands(const CalibrationData& data) {
  const auto run = std::make_shared<RunData>(RunData{data});
  HostedIslands hosted;
  for (const IslandKey& island : islands(data.archipelago)) {
    hosted[island] = std::make_shared<HostedIsland>(
        run,
        IslandTask{.run = data.run, .island = island, .attempt = 1, .worker = "worker", .start = {}, .recent = {}});
  }
  return hosted;
}

std::vector<EpochBatch::Member> members_of(const HostedIslands& hosted) {
  std::vector<EpochBatch::Member> members;
  for (const auto& [island, one] : hosted) members.push_back({one, false});
  return members;
}

TEST(EpochBatch, BreedsToTheBitWhatIslandsBreedInStep) {
  const CalibrationData data = busy_run();
  const HostedIslands together = hosted_islands(data), in_step = hosted_islands(data);
  EpochBatch(members_of(together), {}).breed(kLong, [] {});
  MigrantStore store;
  while (!in_step.begin()->second->finished()) {
    for (const auto& [island, one] : in_step) one->run_epoch(one->immigrants(store), [] {});
    for (const auto& [island, one] : in_step) store.put(one->last_migrants());
  }
  for (const auto& [island, one] : together) {
    EXPECT_TRUE(one->finished());
    EXPECT_EQ(one->outcome("worker"), in_step.at(island)->outcome("worker"));
  }
}

TEST(EpochBatch, EndsAfterAnEpochOfAnIslandThatAnotherWorkerWaitsFor) {
  for (std::size_t awaited = 0; awaited < 6; ++awaited) {
    const HostedIslands hosted = hosted_islands(busy_run());
    std::vector<EpochBatch::Member> members = members_of(hosted);
    members[awaited].is_awaited = true;
    EpochBatch(members, {}).breed(kLong, [] {});
    EXPECT_EQ(members[awaited].island->epoch(), 1U);
  }
}

TEST(EpochBatch, EndsWhenItsTimeIsOverOrItIsToldTo) {
  const auto epochs_of = [](const HostedIslands& hosted) {
    std::uint32_t epochs = 0;
    for (const auto& [island, one] : hosted) epochs += one->epoch();
    return epochs;
  };
  const HostedIslands timed = hosted_islands(busy_run()), told = hosted_islands(busy_run());
  EpochBatch(members_of(timed), {}).breed(kAtOnce, [] {});
  EXPECT_EQ(epochs_of(timed), 1U);
  EpochBatch batch(members_of(told), {});
  batch.end_soon();
  batch.breed(kLong, [] {});
  EXPECT_EQ(epochs_of(told), 1U);
}

TEST(EpochBatch, EndsBeforeNeighboursForgetWhatAnIslandSent) {
  const HostedIslands hosted = hosted_islands(busy_run(3 * kMigrantEpochs));
  EpochBatch(members_of(hosted), {}).breed(kLong, [] {});
  for (const auto& [island, one] : hosted) {
    EXPECT_GT(one->epoch(), 1U);
    EXPECT_LE(one->epoch(), std::uint32_t{kMigrantEpochs / 4});
  }
}

TEST(EpochBatch, EndsWhereAnIslandLacksMigrantsAndGoesOnWithThoseThatCame) {
  const CalibrationData data = busy_run();
  const HostedIslands all = hosted_islands(data);
  const std::shared_ptr<HostedIsland> alone = all.begin()->second;
  EpochBatch({{alone, false}}, {}).breed(kLong, [] {});
  ASSERT_EQ(alone->epoch(), 1U);
  MigrantStore arrived;
  for (const IslandKey& source : alone->sources()) {
    all.at(source)->run_epoch({}, [] {});
    arrived.put(all.at(source)->last_migrants());
  }
  MigrantStore theirs;
  theirs.copy(arrived, alone->sources(), alone->epoch());
  EpochBatch({{alone, false}}, theirs).breed(kLong, [] {});
  EXPECT_EQ(alone->epoch(), 2U);
}

TEST(EpochBatch, LinksThoseThatExchangeMigrants) {
  const auto linked = [](const HostedIslands& hosted) { return linked_with(hosted.begin()->second, hosted).size(); };
  EXPECT_EQ(linked(hosted_islands(busy_run())), 3U);
  EXPECT_EQ(linked(hosted_islands(busy_run(30, true))), 6U);
  HostedIslands some = hosted_islands(busy_run());
  std::erase_if(some, [](const auto& entry) { return entry.first.joint == 0 && entry.first.deme == 1; });
  EXPECT_EQ(linked(some), 2U);
}

}  // namespace
}  // namespace demecal
