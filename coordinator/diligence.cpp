#include "coordinator/diligence.hpp"

#include <algorithm>

namespace demecal {

Diligence::Diligence(const Archipelago& archipelago, Time now) : waits_(!archipelago.asynchronous) {
  for (const IslandKey island : islands(archipelago)) islands_[island] = {sources(archipelago, island), 0, now};
}

void Diligence::given(IslandKey island, std::uint32_t epoch, Time now) {
  Isle& isle = islands_.at(island);
  isle.epoch = epoch;
  isle.since = now;
}

void Diligence::reached(IslandKey island, std::uint32_t epoch, Time now) {
  Isle& isle = islands_.at(island);
  if (epoch <= isle.epoch) return;
  longest_ = std::max(longest_, now - isle.since);
  isle.epoch = epoch;
  isle.since = now;
}

std::vector<IslandKey> Diligence::stalled(Time now, std::chrono::milliseconds patience) const {
  constexpr int kTimesLongest = 4;
  const Time before = now - std::max<Time::duration>(patience, kTimesLongest * longest_);
  std::vector<IslandKey> all;
  for (const auto& [key, isle] : islands_)
    if (is_stalled(isle, before)) all.push_back(key);
  return all;
}

/// A source that was lately seen to get on may have let the island go on only then.
bool Diligence::is_stalled(const Isle& isle, Time before) const {
  if (isle.is_finished || isle.since > before) return false;
  return !waits_ || isle.epoch == 0 || std::ranges::all_of(isle.sources, [&](const IslandKey& key) {
    const Isle& source = islands_.at(key);
    return source.is_finished || (source.epoch >= isle.epoch && source.since <= before);
  });
}

}  // namespace demecal
