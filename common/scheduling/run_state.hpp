// How far a run is: what its islands have reported, as the coordinator knows it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "protocol/messages.hpp"

namespace demecal::inline scheduling {

enum class RunEnd {
  finished,
  no_worker,
  interrupted,
  stuck  ///< islands wait for migrants that nobody keeps any more
};

/// What came of a run; of an interrupted one, what the islands had reached.
struct RunResult {
  RunEnd end = RunEnd::finished;
  std::map<IslandKey, Population> fronts;  ///< best of each length, per island
  std::vector<Progress> history;           ///< one per island and epoch, by island, then epoch
  std::uint32_t generations = 0;           ///< over all islands
  std::uint64_t evaluations = 0;
  std::uint64_t migrations = 0;  ///< individuals taken in
  std::size_t workers = 0;       ///< different ones that finished an island
  std::uint64_t rejected = 0;    ///< messages that were received and not acted on, since they could not be believed
  std::map<std::string, WorkerStatus> present;  ///< workers that were there at the end, by name
  std::map<std::string, double> waited_share;   ///< of each worker heard of: of its slots' time while it had islands to
                                                ///< breed, the share without work
};

/// Grows with the messages it is given; late, doubled and faulty ones change nothing.
class RunState {
 public:
  explicit RunState(CalibrationData data);

  const CalibrationData& data() const { return data_; }
  /// The same evolution goes on as another run.
  void rename(RunId run);

  /// Whether the message brought something new.
  bool take(const Progress& progress);
  bool take(const Checkpoint& checkpoint);
  bool take(const Outcome& outcome);

  /// Completed, by the last checkpoint.
  std::uint32_t epoch(IslandKey island) const { return islands_.at(island).reached.epoch; }
  bool all_finished() const { return finished_ == islands_.size(); }
  /// Whether every island's last epoch was reported; the outcome may come before.
  bool has_all_progress() const;
  /// The task of going on with the island from where it is known to be.
  IslandTask task(IslandKey island, std::uint32_t attempt, const std::string& worker) const;
  /// Whether an island is so far behind a source that the source's migrants it needs next are kept nowhere: nobody can
  /// take it up from its last checkpoint.
  bool any_out_of_reach() const;

  /// All that is known, as messages from which the same state grows.
  std::vector<Progress> progress() const;
  std::vector<Checkpoint> checkpoints() const;
  std::vector<Outcome> outcomes() const;
  RunResult result(RunEnd end) const;

 private:
  struct IslandRecord {
    IslandState reached;  ///< the last checkpoint
    std::vector<Migrants> recent;
    std::map<std::uint32_t, Progress> progress;  ///< by epoch
    std::optional<Outcome> outcome;
  };

  CalibrationData data_;
  std::map<IslandKey, IslandRecord> islands_;
  std::size_t finished_ = 0;
};

}  // namespace demecal::inline scheduling
