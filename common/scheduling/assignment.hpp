// Which worker owns which island: handed out evenly, moved when workers come and go, and taken from workers that stall.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "evolution/archipelago.hpp"

namespace demecal::inline scheduling {

/// One decision: this island belongs to that worker from now on.
struct Move {
  IslandKey island;
  std::string worker;
};

/// The assignment of islands to present workers, in proportion to their slots. A finished island is still owned, since
/// its last emigrants may be wanted, but is no load. It only decides; telling the workers is the caller's part.
class Assignment {
 public:
  explicit Assignment(const std::vector<IslandKey>& islands);

  void add_worker(const std::string& worker, std::uint32_t slots);
  /// Its islands are without a worker from now on.
  void remove_worker(const std::string& worker);
  /// The island has no work left.
  void finish(IslandKey island);

  /// The moves that give every island a worker and even the load out, applied at once: islands without a
  /// worker go to the least loaded one and, in key order, on to the same as long as that is no more than its share,
  /// since neighbours then sit together and need no network; then islands move from the most to the least loaded
  /// worker, if that has an idle slot, while it shortens the longest queue and `may_move` agrees. Empty without
  /// workers.
  std::vector<Move> balance(const std::function<bool(IslandKey)>& may_move = {});

  /// Empty where the island is without a worker.
  const std::string& owner(IslandKey island) const { return islands_.at(island).owner; }
  bool has_workers() const { return !workers_.empty(); }
  std::size_t worker_count() const { return workers_.size(); }

 private:
  struct IslandEntry {
    std::string owner;  ///< empty where none
    bool is_finished = false;
  };
  struct WorkerEntry {
    std::uint32_t slots = 1;
    int unfinished = 0;  ///< islands
  };

  double load(const std::string& worker, int more) const;
  double fair_load() const;
  std::string least_loaded() const;
  std::string most_loaded() const;
  void assign(IslandKey island, const std::string& worker, std::vector<Move>& moves);

  std::map<IslandKey, IslandEntry> islands_;
  std::map<std::string, WorkerEntry> workers_;
};

/// An island that lacks nothing and makes no progress shows that its worker does not work, whatever that says of
/// itself. Times are arguments and never go back.
class StallDetector {
 public:
  using Time = std::chrono::steady_clock::time_point;

  StallDetector(const Archipelago& archipelago, Time now);

  /// A worker begins with the island after so many epochs.
  void assigned(IslandKey island, std::uint32_t epoch, Time now);
  /// So many epochs of the island are known to be completed.
  void reached(IslandKey island, std::uint32_t epoch, Time now);
  void finished(IslandKey island) { islands_.at(island).is_finished = true; }

  /// Islands without progress for `patience`, and for several times as long as any took for an epoch, while their
  /// sources were as far as they.
  std::vector<IslandKey> stalled(Time now, std::chrono::milliseconds patience) const;

 private:
  struct IslandProgress {
    std::vector<IslandKey> sources;
    std::uint32_t epoch = 0;
    Time since;  ///< of its last progress, or assignment
    bool is_finished = false;
  };
  bool is_stalled(const IslandProgress& island, Time before) const;

  bool waits_;  ///< for sources
  std::map<IslandKey, IslandProgress> islands_;
  Time::duration longest_{};  ///< that an island took for an epoch
};

/// A worker that stalled is given no islands for a while: for longer each time.
class Quarantine {
 public:
  using Time = StallDetector::Time;

  void begin(Time now, std::chrono::milliseconds patience);
  void end() { is_active_ = false; }
  bool is_active() const { return is_active_; }
  bool is_over(Time now) const { return now >= until_; }

 private:
  Time until_;
  int times_ = 0;  ///< so often so far
  bool is_active_ = false;
};

}  // namespace demecal::inline scheduling
