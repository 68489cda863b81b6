// A worker: takes islands from whichever coordinator serves its domain, evolves them, and says how they fare.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "transport/transport.hpp"
#include "worker/inbox.hpp"
#include "worker/slots.hpp"
#include "worker/tenancy.hpp"
#include "worker/unproven.hpp"

namespace demecal {

struct WorkerOptions {
  std::string name;  ///< unique among all workers
  std::string host;
  std::uint32_t process = 0;
  std::uint32_t slots = 1;                   ///< islands computed at once
  RunId only_run = 0;                        ///< 0: serves every run
  std::function<void()> after_generation{};  ///< called by the slot that bred it: for work that is only simulated
};

class Worker {
 public:
  Worker(Transport& transport, const WorkerOptions& options);

  /// Works until `stop` is set, then says goodbye. With only_run set it also ends when that run does.
  void serve(const std::atomic<bool>& stop);

 private:
  using Place = std::pair<RunId, IslandKey>;

  void receive(const Message& message);
  void take(const CalibrationData& data);
  void take(const IslandTask& task);
  void take(const Migrants& migrants);
  void take(const Control& control);
  void name(const IslandTask& task);
  void keep_for_later(const IslandTask& task);
  void begin(const IslandTask& task);
  void start_ready();
  WaitedShare::Time note_waiting();
  bool start_one();
  void finish(const std::shared_ptr<Tenancy>& done);
  void announce(bool leaving);
  void forget_run(RunId run);
  void keep_alive();

  Transport& transport_;
  WorkerOptions options_;
  std::map<RunId, std::shared_ptr<const RunData>> runs_;
  std::map<RunId, Inbox> inboxes_;
  std::map<RunId, std::map<IslandKey, IslandTask>> waiting_;  ///< tasks that came before their run's data
  std::size_t waiting_tasks_ = 0;
  Unproven unproven_;                             ///< migrants of runs without data, or whose sender no task has named
  std::map<Place, std::set<std::string>> named_;  ///< whom tasks have given an island
  std::map<Place, std::shared_ptr<Tenancy>> tenancies_;
  std::map<Place, std::uint32_t> attempts_;  ///< highest seen, ours or another's
  std::set<std::shared_ptr<Tenancy>> busy_;
  std::set<RunId> ended_;
  std::deque<RunId> ended_in_order_;  ///< the last ones are remembered
  Slots<std::shared_ptr<Tenancy>> slots_;
  std::uint64_t beats_seen_ = 0;
  WaitedShare slots_waited_;
  WaitedShare::Time announced_{};
};

}  // namespace demecal
