// A worker: takes islands from whichever coordinator serves its domain, evolves them, and says how they fare.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "transport/transport.hpp"
#include "worker/holders.hpp"
#include "worker/migrant_store.hpp"
#include "worker/slots.hpp"
#include "worker/spell.hpp"
#include "worker/tenancy.hpp"
#include "worker/unproven.hpp"

namespace demecal {

struct WorkerOptions {
  std::string name;  ///< unique among all workers
  std::string host;
  std::uint32_t process = 0;
  std::uint32_t slots = 1;                              ///< islands computed at once
  RunId only_run = 0;                                   ///< 0: serves every run; else those of this one's publisher
  std::chrono::milliseconds progress_interval{250};     ///< at least, between two words of an island's progress
  std::chrono::milliseconds checkpoint_interval{1000};  ///< at least, but for islands of many epochs a second
  std::chrono::milliseconds spell{20};       ///< about so long, islands that need nobody else breed without a word
  std::function<void()> after_run{};         ///< called when what was kept of a run has been dropped
  std::function<void()> after_generation{};  ///< called by the slot that bred it: for work that is only simulated
};

class Worker {
 public:
  Worker(Transport& transport, const WorkerOptions& options);

  /// Works until `stop` is set, then says goodbye. Transport::wake() has it notice that at once.
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
  void hand_over(const Place& place);
  void hand_all_over();
  void collect_spells();
  void tell_all(Tenancy& tenancy);
  void reach(const Place& place);
  void send_migrants(Tenancy& tenancy);
  bool is_elsewhere(RunId run, IslandKey island) const;
  bool is_awaited_elsewhere(const Tenancy& tenancy) const;
  bool is_finished(RunId run) const;
  std::optional<Place> place_of(RunId run) const;
  void start_ready();
  WaitedShare::Time note_waiting();
  std::shared_ptr<Tenancy> slowest_ready() const;
  std::map<IslandKey, std::shared_ptr<Tenancy>> free_tenancies(RunId run) const;
  bool start_one();
  void finish(const Spell& spell);
  void finish(const Spell::Member& member);
  std::chrono::milliseconds checkpoint_interval() const;
  void announce(bool leaving);
  void forget_run(RunId run);
  void keep_alive();

  Transport& transport_;
  WorkerOptions options_;
  std::map<RunId, std::shared_ptr<const RunData>> runs_;
  std::map<RunId, MigrantStore> arrived_;
  std::map<RunId, std::map<IslandKey, IslandTask>> waiting_;  ///< tasks that came before their run's data
  std::size_t waiting_tasks_ = 0;
  Unproven unproven_;  ///< migrants of runs without data, or whose sender no task has named
  Holders holders_;
  std::map<Place, std::shared_ptr<Tenancy>> tenancies_;
  std::map<std::shared_ptr<Tenancy>, std::shared_ptr<Spell>> busy_;  ///< those in a spell
  std::map<RunId, Control::State> ended_;
  std::deque<RunId> ended_in_order_;  ///< the last ones are remembered
  Slots<std::shared_ptr<Spell>> slots_;
  std::uint64_t beats_seen_ = 0;
  WaitedShare slots_waited_;
  WaitedShare::Time announced_{}, asserted_{};
};

}  // namespace demecal
