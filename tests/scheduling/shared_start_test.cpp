// What runs cost at their ends: islands are shared out once, and workers tidy up when nothing follows.
#include <gtest/gtest.h>

#include "in_memory_run.hpp"

namespace demecal {
namespace {

TEST(EvolutionRun, WorkersThatAreThereShareTheIslandsBeforeAnyIsBegun) {
  const CalibrationData data = small_run(14);
  const auto exchange = make_exchange();
  const auto first = join(exchange, Role::worker, "a"), second = join(exchange, Role::worker, "b");
  for (const auto& [name, worker] : {std::pair("a", first.get()), std::pair("b", second.get())})
    worker->publish(WorkerStatus{.worker = name, .host = "here", .process = 1, .slots = 1, .version = "1"});
  class EndOnTick : public RunObserver {
   public:
    explicit EndOnTick(std::atomic<bool>& interrupt) : interrupt_(interrupt) {}
    void on_tick() override { interrupt_ = true; }

   private:
    std::atomic<bool>& interrupt_;
  };
  std::atomic<bool> interrupt{false};
  EndOnTick observer(interrupt);
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  EvolutionRun(*transport, data, observer).run(interrupt, {});
  std::size_t tasks = 0;
  while (const auto message = first->receive(std::chrono::milliseconds(0)))
    if (std::holds_alternative<IslandTask>(*message)) ++tasks;
  EXPECT_EQ(tasks, islands(data.archipelago).size());
}

TEST(Worker, TidiesUpOnceNoRunHasFollowedForASecond) {
  const auto exchange = make_exchange();
  const auto of_worker = join(exchange, Role::worker, "worker");
  std::atomic<bool> stop{false};
  std::atomic<int> tidied{0};
  std::thread thread([&] {
    Worker(*of_worker, {.name = "worker", .host = "here", .process = 1, .after_runs = [&] { ++tidied; }}).serve(stop);
  });
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  RunObserver silent;
  const std::atomic<bool> interrupt{false};
  const RunResult first = EvolutionRun(*transport, small_run(1), silent).run(interrupt, {});
  EvolutionRun next(*transport, RunState(small_run(2)), silent, first.present);
  EXPECT_EQ(next.run(interrupt, {}).end, RunEnd::finished);
  EXPECT_EQ(tidied, 0);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (tidied == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(tidied, 1);
  stop = true;
  of_worker->wake();
  thread.join();
}

}  // namespace
}  // namespace demecal
