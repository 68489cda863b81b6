// One evolution, seen from the coordinator: publishes the data and the tasks, gathers what the islands found.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "coordinator/assignment.hpp"
#include "coordinator/diligence.hpp"
#include "coordinator/run_state.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// Told what happens, as it happens; of messages, those that tell something new.
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
  std::chrono::milliseconds idle{20000};    ///< without a worker's getting on with an island that lacks nothing
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

  struct Given {
    std::string worker;
    std::uint32_t attempt = 0;
    std::uint32_t epoch = 0;  ///< from which on
    Clock::time_point moment;
    bool answered = false;  ///< by word of an epoch beyond it
  };

  /// A worker that is given no islands for a while, since it has stalled.
  struct Aside {
    std::uint32_t slots = 1;
    Clock::time_point until;
    int times = 0;  ///< so often so far
    bool now = false;
  };

  RunEnd work(const std::atomic<bool>& interrupt, RunPatience patience);
  bool waits_for_history();
  void end(Control::State state);
  void hear_last_words();
  void receive(const Message& message);
  void take(const WorkerStatus& status);
  void take(const Progress& progress);
  void take(const Checkpoint& checkpoint);
  void take(const Outcome& outcome);
  template <class IslandMessage>
  bool is_credible(const IslandMessage& message);
  void lose(const std::string& worker);
  void set_idle_aside(std::chrono::milliseconds patience);
  void take_back(Clock::time_point now);
  void count_strangers();
  void hand_out();
  void give(IslandKey island, const std::string& worker);
  void give_again();
  void give_again(IslandKey island);

  Transport& transport_;
  RunState state_;
  RunObserver& observer_;
  Assignment assignment_;
  Diligence diligence_;
  std::map<IslandKey, Given> given_;                  ///< the last task of each island
  std::map<IslandKey, std::set<std::string>> named_;  ///< whom tasks have given it
  std::map<std::string, Aside> aside_;                ///< by worker
  std::map<std::string, WorkerStatus> present_;
  std::map<std::string, std::uint64_t> of_other_runs_;  ///< how much was heard, by worker
  std::map<std::string, double> waited_share_;          ///< by worker
  Clock::time_point last_news_;
};

}  // namespace demecal
