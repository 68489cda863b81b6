// The migrants that have arrived for islands here, kept until the epoch that takes them in.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "protocol/messages.hpp"

namespace demecal {

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

}  // namespace demecal
