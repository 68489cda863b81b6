#include "hosting/migrants.hpp"

#include <algorithm>
#include <iterator>

namespace demecal::inline hosting {
namespace {

constexpr std::size_t kMostAssigned = 1024;

}  // namespace

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

bool IslandOwners::add(const IslandTask& task) {
  std::set<std::string>& assigned = owners_[{task.run, task.island}].assigned;
  return assigned.size() < kMostAssigned && assigned.insert(task.worker).second;
}

bool IslandOwners::assign(const IslandTask& task) {
  Owner& owner = owners_[{task.run, task.island}];
  if (task.attempt <= owner.attempt) return false;
  owner.attempt = task.attempt;
  owner.worker = task.worker;
  return true;
}

bool IslandOwners::is_elsewhere(const IslandOfRun& place, const std::string& worker) const {
  const auto owner = owners_.find(place);
  return owner != owners_.end() && owner->second.attempt > 0 && owner->second.worker != worker;
}

bool IslandOwners::was_assigned(const IslandOfRun& place, const std::string& worker) const {
  const auto owner = owners_.find(place);
  return owner != owners_.end() && owner->second.assigned.contains(worker);
}

std::set<std::string> IslandOwners::forget(RunId run) {
  std::set<std::string> assigned;
  for (auto owner = owners_.begin(); owner != owners_.end();) {
    if (owner->first.first != run) {
      ++owner;
      continue;
    }
    assigned.merge(owner->second.assigned);
    owner = owners_.erase(owner);
  }
  return assigned;
}

bool UnverifiedMigrants::put(const Migrants& migrants) {
  if (by_sender_.size() >= kMostSenders && !by_sender_.contains(migrants.worker)) return false;
  auto& all = by_sender_[migrants.worker];
  all.push_back(migrants);
  if (all.size() <= kMostOfOne) return true;
  all.pop_front();
  return false;
}

std::vector<Migrants> UnverifiedMigrants::take(const std::string& worker, RunId run, IslandKey island) {
  std::vector<Migrants> taken;
  const auto all = by_sender_.find(worker);
  if (all == by_sender_.end()) return taken;
  std::erase_if(all->second, [&](const Migrants& one) {
    const bool is_one = one.run == run && one.island == island;
    if (is_one) taken.push_back(one);
    return is_one;
  });
  if (all->second.empty()) by_sender_.erase(all);
  return taken;
}

std::map<std::string, std::size_t> UnverifiedMigrants::forget(RunId run) {
  std::map<std::string, std::size_t> forgotten;
  for (auto& [worker, all] : by_sender_) {
    if (const std::size_t count = std::erase_if(all, [run](const Migrants& one) { return one.run == run; }); count > 0)
      forgotten[worker] = count;
  }
  std::erase_if(by_sender_, [](const auto& entry) { return entry.second.empty(); });
  return forgotten;
}

}  // namespace demecal::inline hosting
