// The migrants that have arrived for islands here, kept until the epoch that takes them in.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/messages.hpp"

namespace demecal {

/// Emigrants of one run by source island and epoch. Late and doubled ones change nothing: an island's emigrants of an
/// epoch are the same whoever sends them.
class Inbox {
 public:
  void put(const Migrants& migrants);

  /// What `sources` sent after completing `epoch` epochs, in the order of `sources`; nothing while any of them is
  /// missing.
  std::optional<Population> collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const;

  /// Drops what left before `epoch` epochs were complete: no island here will ask for it again.
  void forget_before(std::uint32_t epoch);

 private:
  std::map<std::pair<IslandKey, std::uint32_t>, Population> by_source_;
};

}  // namespace demecal
