// Which worker holds which island: handed out evenly, moved when workers come and go.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "evolution/archipelago.hpp"

namespace demecal {

/// One decision: this island belongs to that worker from now on.
struct Move {
  IslandKey island;
  std::string worker;
};

/// The assignment of islands to present workers, in proportion to their slots. A finished island is still held, since
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
  /// since neighbours then sit together and need no network; then islands move from the most to the least loaded worker
  /// while that shortens the longest queue. Empty where there are no workers.
  std::vector<Move> balance();

  /// Empty where the island is without a worker.
  const std::string& holder(IslandKey island) const { return holder_.at(island); }
  bool has_workers() const { return !slots_.empty(); }
  std::size_t worker_count() const { return slots_.size(); }

 private:
  double load(const std::string& worker, int more) const;
  double fair_load() const;
  std::string least_loaded() const;
  std::string most_loaded() const;
  void give(IslandKey island, const std::string& worker, std::vector<Move>& moves);

  std::map<IslandKey, std::string> holder_;  ///< empty where none
  std::set<IslandKey> finished_;
  std::map<std::string, std::uint32_t> slots_;
  std::map<std::string, int> held_;  ///< unfinished islands
};

}  // namespace demecal
