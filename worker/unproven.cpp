#include "worker/unproven.hpp"

#include <algorithm>

namespace demecal {

bool Unproven::put(const Migrants& migrants) {
  if (by_sender_.size() >= kMostSenders && !by_sender_.contains(migrants.worker)) return false;
  auto& all = by_sender_[migrants.worker];
  all.push_back(migrants);
  if (all.size() <= kMostOfOne) return true;
  all.pop_front();
  return false;
}

std::vector<Migrants> Unproven::take(const std::string& worker, RunId run, IslandKey island) {
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

std::map<std::string, std::size_t> Unproven::forget(RunId run) {
  std::map<std::string, std::size_t> forgotten;
  for (auto& [worker, all] : by_sender_) {
    if (const std::size_t count = std::erase_if(all, [run](const Migrants& one) { return one.run == run; }); count > 0)
      forgotten[worker] = count;
  }
  std::erase_if(by_sender_, [](const auto& entry) { return entry.second.empty(); });
  return forgotten;
}

}  // namespace demecal
