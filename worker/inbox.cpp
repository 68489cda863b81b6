#include "worker/inbox.hpp"

namespace demecal {

void Inbox::put(const Migrants& migrants) {
  auto& epochs = by_source_[migrants.island];
  epochs.try_emplace(migrants.epoch, migrants.individuals);
  if (epochs.size() > kMigrantEpochs) epochs.erase(epochs.begin());
}

std::optional<Population> Inbox::collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const {
  Population all;
  for (const IslandKey& source : sources) {
    const auto epochs = by_source_.find(source);
    if (epochs == by_source_.end()) return std::nullopt;
    const auto found = epochs->second.find(epoch);
    if (found == epochs->second.end()) return std::nullopt;
    all.insert(all.end(), found->second.begin(), found->second.end());
  }
  return all;
}

}  // namespace demecal
