// One evolution, seen from the coordinator: publishes the data and the tasks, gathers what the islands found.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "coordinator/assignment.hpp"
#include "transport/transport.hpp"

namespace demecal {

enum class RunEnd { finished, no_worker, interrupted };

/// What came of a run; of an interrupted one, what the islands had reached.
struct RunResult {
  RunEnd end = RunEnd::finished;
  std::map<IslandKey, Population> fronts;  ///< best of each length, per island
  std::vector<Progress> history;           ///< one per island and epoch, by island, then epoch
  std::uint32_t generations = 0;           ///< over all islands
  std::uint64_t evaluations = 0;
  std::uint64_t migrations = 0;  ///< individuals taken in
  std::size_t workers = 0;       ///< different ones that finished an island
};

/// Told what happens, as it happens.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_progress(const Progress&) {}
  virtual void on_worker(const WorkerStatus&) {}
  virtual void on_lost(const std::string& /*worker*/) {}
  /// About every tenth of a second.
  virtual void on_tick() {}
};

class EvolutionRun {
 public:
  EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer);

  /// Until every island has bred all its generations, `interrupt` is set, or no worker was there for `worker_patience`.
  RunResult run(const std::atomic<bool>& interrupt, std::chrono::milliseconds worker_patience);

 private:
  struct Isle {
    std::uint32_t attempt = 0;
    IslandState reached;  ///< the last checkpoint
    std::vector<Migrants> recent;
    bool finished = false;
    std::map<std::uint32_t, Progress> progress;  ///< by epoch
  };

  void receive(const Message& message);
  void take(const WorkerStatus& status);
  void take(const Progress& progress);
  void take(const Checkpoint& checkpoint);
  void take(const Outcome& outcome);
  void lose(const std::string& worker);
  void hand_out();
  bool all_finished() const;
  RunResult gather(RunEnd end) const;

  Transport& transport_;
  CalibrationData data_;
  RunObserver& observer_;
  Assignment assignment_;
  std::map<IslandKey, Isle> isles_;
  std::map<IslandKey, Outcome> outcomes_;
};

}  // namespace demecal
