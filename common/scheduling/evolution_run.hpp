// One evolution, seen from the coordinator: publishes the data and the tasks, gathers what the islands found.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "evolution/archipelago.hpp"
#include "protocol/messages.hpp"
#include "scheduling/assignment.hpp"
#include "scheduling/island_pace.hpp"
#include "scheduling/run_state.hpp"
#include "transport/transport.hpp"

namespace demecal::inline scheduling {

/// Is called with what happens, as it happens; of messages, with those that bring something new.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void on_progress(const Progress&) {}
  virtual void on_checkpoint(const Checkpoint&) {}
  virtual void on_outcome(const Outcome&) {}
  virtual void on_worker(const WorkerStatus&) {}
  virtual void on_lost(const std::string& /*worker*/) {}
  /// About every tenth of a second.
  virtual void on_tick() {}
};

/// How long a run is patient.
struct RunPatience {
  std::chrono::milliseconds worker{30000};  ///< without any worker
  std::chrono::milliseconds news{10000};    ///< without news, where an island cannot be taken up
  std::chrono::milliseconds idle{20000};    ///< without a worker's progress with an island that lacks nothing
};

class EvolutionRun {
 public:
  /// Begins at the start of the evolution.
  EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer);
  /// Goes on from what is known; `state` is that of a run whose number is new. `present` are the workers that were
  /// there when the last run over this transport ended: who came or went since, the transport still tells.
  EvolutionRun(Transport& transport, RunState state, RunObserver& observer,
               const std::map<std::string, WorkerStatus>& present = {});

  /// Until every island has bred all its generations, `interrupt` is set, no worker was there for as long as `patience`
  /// says, or the run is stuck. Where an observer throws, the workers are told that the run is over. That it finished
  /// may still be on its way to them: they may serve another.
  RunResult run(const std::atomic<bool>& interrupt, RunPatience patience);

 private:
  using Clock = std::chrono::steady_clock;

  /// An island that was assigned: its last task, and whom tasks have assigned it.
  struct AssignedIsland {
    std::string worker;
    std::uint32_t attempt = 0;
    std::uint32_t epoch = 0;  ///< from which on
    Clock::time_point moment;
    bool answered = false;           ///< by a report of an epoch beyond it
    std::set<std::string> owners{};  ///< ever
  };

  /// A worker that was heard of.
  struct KnownWorker {
    std::optional<WorkerStatus> status{};  ///< while it is there
    std::optional<double> waited_share{};  ///< of whoever said that it is a worker
    Quarantine quarantine{};
    std::uint64_t foreign_messages = 0;  ///< of other runs
  };

  RunEnd work(const std::atomic<bool>& interrupt, RunPatience patience);
  void receive_waiting();
  bool waits_for_history();
  void end(Control::State state);
  void drain_final_messages();
  void receive(const Message& message);
  void take(const WorkerStatus& status);
  void take(const Progress& progress);
  void take(const Checkpoint& checkpoint);
  void take(const Outcome& outcome);
  template <class IslandMessage>
  bool is_credible(const IslandMessage& message);
  void count_foreign(const std::string& worker, RunId run);
  void lose(const std::string& worker);
  void quarantine_stalled(std::chrono::milliseconds patience);
  void end_quarantines(Clock::time_point now);
  void reject_strangers();
  void assign_islands();
  bool is_worth_moving(IslandKey island) const;
  void assign(IslandKey island, const std::string& worker);
  void renew_assignments();
  void renew_assignment(IslandKey island);

  Transport& transport_;
  RunState state_;
  RunObserver& observer_;
  Assignment assignment_;
  StallDetector stalls_;
  IslandPace pace_;
  std::map<IslandKey, AssignedIsland> islands_;
  std::map<std::string, KnownWorker> workers_;
  std::size_t foreign_senders_ = 0;  ///< of messages of other runs
  Clock::time_point last_news_;
};

}  // namespace demecal::inline scheduling
