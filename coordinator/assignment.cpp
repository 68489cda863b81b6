#include "coordinator/assignment.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {

Assignment::Assignment(const std::vector<IslandKey>& islands) {
  for (const IslandKey island : islands) holder_[island];
}

void Assignment::add_worker(const std::string& worker, std::uint32_t slots) {
  slots_[worker] = std::max(slots, 1U);
  held_.try_emplace(worker, 0);
}

void Assignment::remove_worker(const std::string& worker) {
  slots_.erase(worker);
  held_.erase(worker);
  for (auto& [island, holder] : holder_) {
    if (holder == worker) holder.clear();
  }
}

void Assignment::finish(IslandKey island) {
  if (!finished_.insert(island).second) return;
  if (const auto held = held_.find(holder_.at(island)); held != held_.end()) --held->second;
}

std::vector<Move> Assignment::balance() {
  std::vector<Move> moves;
  if (slots_.empty()) return moves;
  std::string filled;
  for (const auto& [island, holder] : holder_) {
    if (!holder.empty()) continue;
    if (filled.empty() || load(filled, 1) > fair_load()) filled = least_loaded();
    give(island, filled, moves);
  }
  while (true) {
    const std::string from = most_loaded(), to = least_loaded();
    if (load(to, 1) >= load(from, 0)) return moves;
    // The last one in key order: its neighbours most often sit with the worker that it leaves.
    const auto last = std::find_if(holder_.rbegin(), holder_.rend(), [&](const auto& entry) {
      return entry.second == from && !finished_.contains(entry.first);
    });
    give(last->first, to, moves);
  }
}

double Assignment::load(const std::string& worker, int more) const {
  return static_cast<double>(held_.at(worker) + more) / slots_.at(worker);
}

/// Of each slot, rounded up: what the busiest has at least.
double Assignment::fair_load() const {
  double slots = 0.0;
  for (const auto& [worker, count] : slots_) slots += count;
  return std::ceil(static_cast<double>(holder_.size() - finished_.size()) / slots);
}

std::string Assignment::least_loaded() const {
  return std::min_element(slots_.begin(), slots_.end(),
                          [this](const auto& a, const auto& b) { return load(a.first, 1) < load(b.first, 1); })
      ->first;
}

std::string Assignment::most_loaded() const {
  return std::max_element(slots_.begin(), slots_.end(),
                          [this](const auto& a, const auto& b) { return load(a.first, 0) < load(b.first, 0); })
      ->first;
}

void Assignment::give(IslandKey island, const std::string& worker, std::vector<Move>& moves) {
  std::string& holder = holder_.at(island);
  const int load = finished_.contains(island) ? 0 : 1;
  if (!holder.empty()) held_.at(holder) -= load;
  holder = worker;
  held_.at(worker) += load;
  std::erase_if(moves, [island](const Move& move) { return move.island == island; });
  moves.push_back({island, worker});
}

}  // namespace demecal
