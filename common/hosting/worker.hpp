// A worker: takes islands from whichever coordinator serves its domain, has them bred, and reports how they fare.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "evolution/archipelago.hpp"
#include "hosting/hosted_island.hpp"
#include "hosting/island_host.hpp"
#include "hosting/migrants.hpp"
#include "protocol/messages.hpp"
#include "transport/transport.hpp"

namespace demecal::inline hosting {

struct WorkerOptions {
  std::string name;  ///< unique among all workers
  std::string host;
  std::uint32_t process = 0;
  std::uint32_t slots = 1;                              ///< islands computed at once
  RunId only_run = 0;                                   ///< 0: serves every run; else those of this one's publisher
  std::chrono::milliseconds progress_interval{250};     ///< at least, between two reports of an island's progress
  std::chrono::milliseconds checkpoint_interval{1000};  ///< at least, but for islands of many epochs a second
  std::chrono::milliseconds batch{100};      ///< about so long, islands that need nobody else breed without a message
  std::function<void()> after_runs{};        ///< called when no island has been here for a second after a run
  std::function<void()> after_generation{};  ///< or set, by the slot that bred it: for simulated work
};

class Worker {
 public:
  Worker(Transport& transport, const WorkerOptions& options);

  /// Works until `stop` is set, then announces that it leaves. Transport::wake() has it notice that at once.
  void serve(const std::atomic<bool>& stop);

 private:
  bool serves(RunId run) const;
  void receive(const Message& message);
  void take(const CalibrationData& data);
  void take(const IslandTask& task);
  void take(const Migrants& migrants);
  void take(const Control& control);
  void keep_for_later(const IslandTask& task);
  void begin(const IslandTask& task);
  void hand_over(const IslandOfRun& place);
  void hand_over_all();
  void finish_batches();
  void publish_state(HostedIsland& island);
  void exchange_with_new_owner(const IslandOfRun& place);
  void send_migrants(HostedIsland& island);
  void publish_due_reports();
  void publish_reports();
  bool is_elsewhere(RunId run, IslandKey island) const;
  bool is_awaited_elsewhere(const HostedIsland& island) const;
  bool is_finished(RunId run) const;
  std::optional<IslandOfRun> any_island_of(RunId run) const;
  void report(const EpochBatch& batch);
  void report(const EpochBatch::Member& member);
  std::chrono::milliseconds checkpoint_interval() const;
  void announce(bool leaving);
  void forget_run(RunId run);
  void keep_alive();
  void note_idleness(WaitedShare::Time now);

  Transport& transport_;
  WorkerOptions options_;
  IslandHost host_;
  std::map<RunId, std::map<IslandKey, IslandTask>> early_tasks_;  ///< that came before their run's data
  std::size_t early_count_ = 0;
  UnverifiedMigrants unverified_;  ///< of runs without data, or whose sender no task has named
  IslandOwners owners_;
  std::deque<Message> reports_;      ///< made and not yet published
  WaitedShare::Time reports_due_{};  ///< at the latest
  std::map<RunId, Control::State> ended_;
  std::deque<RunId> ended_in_order_;  ///< the last ones are remembered
  std::uint64_t heartbeats_seen_ = 0;
  WaitedShare::Time announced_{}, asserted_{};
  std::optional<WaitedShare::Time> idle_since_;  ///< the end of a run, or an island that was here after it
};

}  // namespace demecal::inline hosting
