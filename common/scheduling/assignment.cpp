#include "scheduling/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ratio>
#include <set>
#include <utility>

namespace demecal::inline scheduling {

Assignment::Assignment(const std::vector<IslandKey>& islands) {
  for (const IslandKey island : islands) islands_[island];
}

void Assignment::add_worker(const std::string& worker, std::uint32_t slots) {
  workers_[worker].slots = std::max(slots, 1U);
}

void Assignment::remove_worker(const std::string& worker) {
  workers_.erase(worker);
  for (auto& [key, island] : islands_) {
    if (island.owner == worker) island.owner.clear();
  }
}

void Assignment::finish(IslandKey key) {
  IslandEntry& island = islands_.at(key);
  if (std::exchange(island.is_finished, true)) return;
  if (const auto owner = workers_.find(island.owner); owner != workers_.end()) --owner->second.unfinished;
}

std::vector<Move> Assignment::balance(const std::function<bool(IslandKey)>& may_move) {
  std::vector<Move> moves;
  if (workers_.empty()) return moves;
  std::string filled;
  for (const auto& [key, island] : islands_) {
    if (!island.owner.empty()) continue;
    if (filled.empty() || load(filled, 1) > fair_load()) filled = least_loaded();
    assign(key, filled, moves);
  }
  // Who still has work needs none yet: where all islands of a run end at about the same time, moving them as they do
  // would cost more than it saves.
  std::set<std::string> idle;
  for (const auto& [name, worker] : workers_)
    if (worker.unfinished < static_cast<int>(worker.slots)) idle.insert(name);
  while (true) {
    const std::string from = most_loaded(), to = least_loaded();
    if (!idle.contains(to) || load(to, 1) >= load(from, 0)) return moves;
    // The last one in key order: its neighbours most often sit with the worker that it leaves.
    const auto last = std::find_if(islands_.rbegin(), islands_.rend(), [&](const auto& entry) {
      return entry.second.owner == from && !entry.second.is_finished && (!may_move || may_move(entry.first));
    });
    if (last == islands_.rend()) return moves;
    assign(last->first, to, moves);
  }
}

double Assignment::load(const std::string& worker, int more) const {
  const WorkerEntry& entry = workers_.at(worker);
  return static_cast<double>(entry.unfinished + more) / entry.slots;
}

/// Of each slot, rounded up: what the busiest has at least.
double Assignment::fair_load() const {
  double slots = 0.0;
  for (const auto& [name, worker] : workers_) slots += worker.slots;
  const auto unfinished = std::ranges::count_if(islands_, [](const auto& entry) { return !entry.second.is_finished; });
  return std::ceil(static_cast<double>(unfinished) / slots);
}

std::string Assignment::least_loaded() const {
  return std::min_element(workers_.begin(), workers_.end(),
                          [this](const auto& a, const auto& b) { return load(a.first, 1) < load(b.first, 1); })
      ->first;
}

std::string Assignment::most_loaded() const {
  return std::max_element(workers_.begin(), workers_.end(),
                          [this](const auto& a, const auto& b) { return load(a.first, 0) < load(b.first, 0); })
      ->first;
}

void Assignment::assign(IslandKey key, const std::string& worker, std::vector<Move>& moves) {
  IslandEntry& island = islands_.at(key);
  const int load = island.is_finished ? 0 : 1;
  if (!island.owner.empty()) workers_.at(island.owner).unfinished -= load;
  island.owner = worker;
  workers_.at(worker).unfinished += load;
  std::erase_if(moves, [key](const Move& move) { return move.island == key; });
  moves.push_back({key, worker});
}

StallDetector::StallDetector(const Archipelago& archipelago, Time now) : waits_(!archipelago.asynchronous) {
  for (const IslandKey island : islands(archipelago)) islands_[island] = {sources(archipelago, island), 0, now};
}

void StallDetector::assigned(IslandKey key, std::uint32_t epoch, Time now) {
  IslandProgress& island = islands_.at(key);
  island.epoch = epoch;
  island.since = now;
}

void StallDetector::reached(IslandKey key, std::uint32_t epoch, Time now) {
  IslandProgress& island = islands_.at(key);
  if (epoch <= island.epoch) return;
  longest_ = std::max(longest_, now - island.since);
  island.epoch = epoch;
  island.since = now;
}

std::vector<IslandKey> StallDetector::stalled(Time now, std::chrono::milliseconds patience) const {
  constexpr int kTimesLongest = 4;
  const Time before = now - std::max<Time::duration>(patience, kTimesLongest * longest_);
  std::vector<IslandKey> all;
  for (const auto& [key, island] : islands_)
    if (is_stalled(island, before)) all.push_back(key);
  return all;
}

/// A source that lately made progress may have let the island go on only then.
bool StallDetector::is_stalled(const IslandProgress& island, Time before) const {
  if (island.is_finished || island.since > before) return false;
  return !waits_ || island.epoch == 0 || std::ranges::all_of(island.sources, [&](const IslandKey& key) {
    const IslandProgress& source = islands_.at(key);
    return source.is_finished || (source.epoch >= island.epoch && source.since <= before);
  });
}

void Quarantine::begin(Time now, std::chrono::milliseconds patience) {
  constexpr int kMostDoublings = 10;
  is_active_ = true;
  until_ = now + patience * (1 << std::min(times_++, kMostDoublings));
}

}  // namespace demecal::inline scheduling
