#include "worker/migrant_store.hpp"

#include <algorithm>

namespace demecal {

void MigrantStore::put(const Migrants& migrants) {
  auto& epochs = by_source_[migrants.island];
  epochs.try_emplace(migrants.epoch, migrants.individuals);
  if (epochs.size() > kEpochs) epochs.erase(epochs.begin());
}

void MigrantStore::copy(const MigrantStore& other, const std::vector<IslandKey>& sources, std::uint32_t epoch) {
  for (const IslandKey& source : sources) {
    const auto found = other.by_source_.find(source);
    if (found == other.by_source_.end()) continue;
    auto& epochs = by_source_[source];
    epochs.insert(found->second.lower_bound(epoch), found->second.end());
    epochs.insert(*found->second.rbegin());
  }
}

bool MigrantStore::holds(const std::vector<IslandKey>& sources, std::uint32_t epoch) const {
  return std::ranges::all_of(sources, [&](const IslandKey& source) {
    const auto epochs = by_source_.find(source);
    return epochs != by_source_.end() && epochs->second.contains(epoch);
  });
}

std::optional<Population> MigrantStore::collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const {
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

Population MigrantStore::collect_new(const std::vector<IslandKey>& sources,
                                     std::map<IslandKey, std::uint32_t>& taken) const {
  Population all;
  for (const IslandKey& source : sources) {
    const auto epochs = by_source_.find(source);
    if (epochs == by_source_.end()) continue;
    const auto& [epoch, individuals] = *epochs->second.rbegin();
    if (epoch <= taken[source]) continue;
    taken[source] = epoch;
    all.insert(all.end(), individuals.begin(), individuals.end());
  }
  return all;
}

}  // namespace demecal
