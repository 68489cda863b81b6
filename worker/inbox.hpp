// The migrants that have arrived for islands here, kept until the epoch that takes them in.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "protocol/messages.hpp"

namespace demecal {

/// Emigrants of one run by source island and epoch. Late and doubled ones change nothing: an island's emigrants of an
/// epoch are the same whoever sends them. Of every source the last kMigrantEpochs are kept, whatever islands are here
/// now: one that is behind may be handed over at any time.
class Inbox {
 public:
  void put(const Migrants& migrants);

  /// What `sources` sent after completing `epoch` epochs, in the order of `sources`; nothing while any of them is
  /// missing.
  std::optional<Population> collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const;

 private:
  std::map<IslandKey, std::map<std::uint32_t, Population>> by_source_;  ///< then by epoch
};

}  // namespace demecal
