// The migrants that have arrived for islands here, kept until they are taken in, and from whom they may come: which
// workers own and owned an island, as far as tasks have told this one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "evolution/population.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline hosting {

/// Emigrants of one run by source island and epoch. Late and doubled ones change nothing: an island's emigrants of an
/// epoch are the same whoever sends them. Of every source the last kEpochs are kept, whatever islands are here now:
/// one that is behind may be handed over at any time.
class MigrantStore {
 public:
  /// Many more than are kept elsewhere: what is taken in costs little, and saves an island from waiting in vain.
  static constexpr std::size_t kEpochs = 1024;

  void put(const Migrants& migrants);

  /// Takes over what `other` has of `sources` from `epoch` on, and the last of each.
  void copy(const MigrantStore& other, const std::vector<IslandKey>& sources, std::uint32_t epoch);

  /// Whether all that `sources` sent after completing `epoch` epochs is here.
  bool holds(const std::vector<IslandKey>& sources, std::uint32_t epoch) const;
  /// What `sources` sent after completing `epoch` epochs, in the order of `sources`; nothing while any of them is
  /// missing.
  std::optional<Population> collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const;
  /// The last that each of `sources` sent, of those that sent any after what `taken` says; `taken` is kept up.
  Population collect_new(const std::vector<IslandKey>& sources, std::map<IslandKey, std::uint32_t>& taken) const;

 private:
  std::map<IslandKey, std::map<std::uint32_t, Population>> by_source_;  ///< then by epoch
};

/// An island of a run.
using IslandOfRun = std::pair<RunId, IslandKey>;

class IslandOwners {
 public:
  /// Counts the task's worker among those that were ever assigned the island; at most 1,024 are. Returns whether it is
  /// new there.
  bool add(const IslandTask& task);
  /// Takes the task's worker for the island's owner, unless its attempt is not above all before. Returns whether it
  /// did.
  bool assign(const IslandTask& task);
  /// Whether another than `worker` owns the island, as far as is known.
  bool is_elsewhere(const IslandOfRun& place, const std::string& worker) const;
  /// Whether `worker` was ever assigned the island.
  bool was_assigned(const IslandOfRun& place, const std::string& worker) const;
  /// Returns all who were ever assigned an island of the run.
  std::set<std::string> forget(RunId run);

 private:
  struct Owner {
    std::uint32_t attempt = 0;  ///< the highest that was seen
    std::string worker;
    std::set<std::string> assigned;  ///< ever
  };
  std::map<IslandOfRun, Owner> owners_;
};

/// Migrants whose sender no task has named yet, kept until one does. Of each sender as many as are kept of an island:
/// one that floods pushes out its own.
class UnverifiedMigrants {
 public:
  static constexpr std::size_t kMostOfOne = 4096, kMostSenders = 256;

  /// Whether nothing had to be dropped for it, nor it itself.
  bool put(const Migrants& migrants);
  /// Those of one sender that are of this run and island, which are no longer kept.
  std::vector<Migrants> take(const std::string& worker, RunId run, IslandKey island);
  /// How many each sender has sent for the run; they are no longer kept.
  std::map<std::string, std::size_t> forget(RunId run);

 private:
  std::map<std::string, std::deque<Migrants>> by_sender_;
};

}  // namespace demecal::inline hosting
