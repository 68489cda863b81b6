#include "worker/inbox.hpp"

namespace demecal {

void Inbox::put(const Migrants& migrants) {
  by_source_.try_emplace({migrants.island, migrants.epoch}, migrants.individuals);
}

std::optional<Population> Inbox::collect(const std::vector<IslandKey>& sources, std::uint32_t epoch) const {
  Population all;
  for (const IslandKey& source : sources) {
    const auto found = by_source_.find({source, epoch});
    if (found == by_source_.end()) return std::nullopt;
    all.insert(all.end(), found->second.begin(), found->second.end());
  }
  return all;
}

void Inbox::forget_before(std::uint32_t epoch) {
  std::erase_if(by_source_, [epoch](const auto& entry) { return entry.first.second < epoch; });
}

}  // namespace demecal
