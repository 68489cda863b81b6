// Who has an island and who had it, as far as tasks have told this worker.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "protocol/messages.hpp"

namespace demecal {

using Place = std::pair<RunId, IslandKey>;

class Holders {
 public:
  /// Counts the task's worker among those that were given the island; at most 1,024 are. Returns whether it is new
  /// there.
  bool name(const IslandTask& task);
  /// Takes the task's worker for who has the island; not where the attempt is not above all before. Returns whether it
  /// did.
  bool give(const IslandTask& task);
  /// Whether another than `worker` has the island, as far as is known.
  bool is_elsewhere(const Place& place, const std::string& worker) const;
  /// Whether `worker` was ever given the island.
  bool was_given(const Place& place, const std::string& worker) const;
  /// Returns all who were given an island of the run.
  std::set<std::string> forget(RunId run);

 private:
  struct Holder {
    std::uint32_t attempt = 0;  ///< the highest that was seen
    std::string worker;
    std::set<std::string> given;
  };
  std::map<Place, Holder> holders_;
};

}  // namespace demecal
