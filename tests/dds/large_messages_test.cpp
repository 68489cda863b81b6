// What is larger than a datagram arrives whole, however often it is replaced on its way.
#include <gtest/gtest.h>

#include <set>

#include "network.hpp"
#include "random_messages.hpp"
#include "transport/transport.hpp"

namespace demecal {
namespace {

/// Some hundred kilobytes.
IslandTask large_task(RunId run, std::uint32_t deme, std::uint32_t attempt, RandomMessages& random) {
  IslandTask task;
  task.run = run;
  task.island = {0, deme};
  task.attempt = attempt;
  task.worker = "worker";
  while (task.start.population.size() < 8000) task.start.population.push_back({random.tree(), random.real()});
  return task;
}

TEST(LargeMessages, ArriveWholeHoweverOftenTheyAreReplacedOnTheirWay) {
  constexpr std::uint32_t kDemes = 6, kAttempts = 10;
  DdsNetwork network;
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto worker = network.join(Role::worker, "worker");
  RandomMessages random(71);
  IslandTask first;
  first.run = coordinator->new_run();
  coordinator->publish(random.data_of(first));
  std::vector<IslandTask> tasks;
  for (std::uint32_t deme = 0; deme < kDemes; ++deme) tasks.push_back(large_task(first.run, deme, 0, random));
  for (std::uint32_t attempt = 1; attempt <= kAttempts; ++attempt)
    for (IslandTask& task : tasks) {
      task.attempt = attempt;
      coordinator->publish(task);
    }
  std::set<std::uint32_t> arrived;
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  while (arrived.size() < kDemes && std::chrono::steady_clock::now() < deadline) {
    coordinator->receive(std::chrono::milliseconds(1));
    const auto message = worker->receive(std::chrono::milliseconds(10));
    if (!message) continue;
    if (const auto* task = std::get_if<IslandTask>(&*message); task != nullptr && task->attempt == kAttempts) {
      EXPECT_EQ(*task, tasks[task->island.deme]);
      arrived.insert(task->island.deme);
    }
  }
  EXPECT_EQ(arrived.size(), kDemes);
}

}  // namespace
}  // namespace demecal
