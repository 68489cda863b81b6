// A whole run in one process: a coordinator and workers as threads over the in-memory transport.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hosting/worker.hpp"
#include "random/random_stream.hpp"
#include "scheduling/evolution_run.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// A small run of two joints: noisy smooth targets of order one.
inline CalibrationData small_run(std::uint64_t seed, Topology topology = Topology::ring, bool between_joints = false) {
  CalibrationData data;
  data.run = 1000 + seed;
  data.job = "small";
  data.seed = seed;
  data.parameters.population_size = 40;
  data.parameters.number_generations = 12;
  data.archipelago = {.joints = {0, 2},
                      .demes_per_joint = 3,
                      .topology = topology,
                      .migration_interval = 3,
                      .migrants = 2,
                      .between_joints = between_joints};
  RandomStream random{seed, 77};
  for (std::size_t joint = 0; joint < data.archipelago.joints.size(); ++joint) {
    TrainingTable table;
    table.variables.resize(1);
    for (int row = 0; row < 20; ++row) {
      const double theta = random.real(-2.0, 2.0);
      table.variables[0].push_back(theta);
      table.target.push_back(std::sin(theta) + 0.3 * theta + 0.05 * random.normal());
      table.weight.push_back(1.0);
    }
    data.tables.push_back(table);
  }
  return data;
}

/// Between checkpoints, ten times as long as a batch: every epoch, or many of them.
inline constexpr std::chrono::milliseconds kAllCheckpoints{0}, kSomeCheckpoints{20};

/// A worker in a thread of its own, from now until it is stopped.
class WorkerThread {
 public:
  /// It tells of every epoch.
  WorkerThread(const std::shared_ptr<Exchange>& exchange, const std::string& name, std::uint32_t slots = 1,
               std::chrono::milliseconds checkpoint_interval = kSomeCheckpoints)
      : WorkerThread(join(exchange, Role::worker, name), name, slots, checkpoint_interval) {}
  WorkerThread(std::unique_ptr<Transport> transport, const std::string& name, std::uint32_t slots,
               std::chrono::milliseconds checkpoint_interval = kSomeCheckpoints, RunId only_run = 0)
      : transport_(std::move(transport)), thread_([this, name, slots, checkpoint_interval, only_run] {
          Worker(*transport_, {.name = name,
                               .host = "here",
                               .process = 1,
                               .slots = slots,
                               .only_run = only_run,
                               .progress_interval = std::chrono::milliseconds(0),
                               .checkpoint_interval = checkpoint_interval,
                               .batch = checkpoint_interval / 10})
              .serve(stop_);
        }) {}
  ~WorkerThread() { stop(); }
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  void stop() {
    stop_ = true;
    if (thread_.joinable()) {
      transport_->wake();
      thread_.join();
    }
  }

 private:
  std::unique_ptr<Transport> transport_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// Runs `data` on `workers` workers that are there before the coordinator.
inline RunResult run_in_memory(const CalibrationData& data, int workers, std::uint32_t slots = 1) {
  const auto exchange = make_exchange();
  std::vector<std::unique_ptr<WorkerThread>> threads;
  for (int i = 0; i < workers; ++i) {
    threads.push_back(std::make_unique<WorkerThread>(exchange, "worker-" + std::to_string(i), slots));
  }
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  RunObserver silent;
  const std::atomic<bool> interrupt{false};
  return EvolutionRun(*transport, data, silent).run(interrupt, {});
}

/// Whether two runs found the same, to the bit.
inline bool same_fronts(const RunResult& a, const RunResult& b) {
  return a.fronts == b.fronts;
}

}  // namespace demecal
