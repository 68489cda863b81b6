// Messages that look as if they belonged to a run, and do not.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/messages.hpp"
#include "random/random_stream.hpp"

namespace demecal {

/// Listens to what a coordinator tells its workers, and makes up the rest.
class Forger {
 public:
  explicit Forger(std::uint64_t seed) : random_{seed, 666} {}

  void hear(const Message& message);

  /// One that is well formed: of the run that was heard of last or of one that there is not, in the name of one of its
  /// workers or of none.
  Message forge();

 private:
  Message forge_about(IslandKey island, const std::string& worker);
  /// An island's true state, but of other data and another seed.
  const Checkpoint& bred(IslandKey island);

  RandomStream random_;
  std::optional<CalibrationData> data_;
  std::optional<CalibrationData> other_data_;  ///< under the same number
  std::vector<std::string> workers_{"intruder"};
  std::map<IslandKey, Checkpoint> bred_;
};

}  // namespace demecal
