#include "hosting/island_host.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace demecal::inline hosting {

EpochBatch::EpochBatch(std::vector<Member> members, MigrantStore arrived)
    : members_(std::move(members)), arrived_(std::move(arrived)) {
  for (Member& member : members_) member.first_epoch = member.island->epoch();
}

void EpochBatch::breed(std::chrono::steady_clock::duration budget, const std::function<void()>& heartbeat) {
  const auto end = std::chrono::steady_clock::now() + budget;
  while (const Member* member = next()) {
    HostedIsland& island = *member->island;
    island.run_epoch(island.immigrants(arrived_), heartbeat);
    arrived_.put(island.last_migrants());
    ended_ = island.epoch_ended();
    if (ends_ || ended_ >= end || member->is_awaited || island.epoch() - member->first_epoch >= kMostEpochs) return;
  }
}

const EpochBatch::Member* EpochBatch::next() const {
  const Member* slowest = nullptr;
  for (const Member& member : members_) {
    if (member.island->finished() || (slowest && slowest->island->epoch() <= member.island->epoch())) continue;
    if (member.island->is_ready(arrived_)) slowest = &member;
  }
  return slowest;
}

std::vector<std::shared_ptr<HostedIsland>> linked_with(
    const std::shared_ptr<HostedIsland>& island, const std::map<IslandKey, std::shared_ptr<HostedIsland>>& islands) {
  std::vector<std::shared_ptr<HostedIsland>> linked{island};
  std::set<IslandKey> seen{island->island()};
  const auto reach = [&](const std::vector<IslandKey>& neighbours) {
    for (const IslandKey& neighbour : neighbours) {
      const auto found = islands.find(neighbour);
      if (found != islands.end() && seen.insert(neighbour).second) linked.push_back(found->second);
    }
  };
  for (std::size_t i = 0; i < linked.size(); ++i) {
    const std::shared_ptr<HostedIsland> member = linked[i];
    reach(member->sources());
    reach(member->consumers());
  }
  return linked;
}

IslandHost::IslandHost(const IslandHostOptions& options, std::function<void()> on_finished)
    : options_(options), slots_(options.slots, std::move(on_finished)) {}

void IslandHost::begin_run(const CalibrationData& data) {
  runs_[data.run] = std::make_shared<RunData>(data);
  arrived_[data.run];
}

void IslandHost::forget_run(RunId run) {
  std::erase_if(islands_, [run](const auto& entry) { return entry.first.first == run; });
  runs_.erase(run);
  arrived_.erase(run);
}

const CalibrationData* IslandHost::data(RunId run) const {
  const auto found = runs_.find(run);
  return found == runs_.end() ? nullptr : &found->second->data;
}

std::shared_ptr<HostedIsland> IslandHost::host(const IslandTask& task) {
  const auto island = std::make_shared<HostedIsland>(runs_.at(task.run), task);
  islands_[{task.run, task.island}] = island;
  for (const Migrants& migrants : task.recent) arrived_[task.run].put(migrants);
  return island;
}

std::shared_ptr<HostedIsland> IslandHost::release(const IslandOfRun& place) {
  const auto held = islands_.extract(place);
  if (held.empty()) return nullptr;
  const auto busy = busy_.find(held.mapped());
  if (busy == busy_.end()) return held.mapped();
  busy->second->end_soon();
  return nullptr;
}

std::shared_ptr<HostedIsland> IslandHost::find(const IslandOfRun& place) const {
  const auto found = islands_.find(place);
  return found == islands_.end() ? nullptr : found->second;
}

bool IslandHost::has_unfinished(RunId run) const {
  return std::ranges::any_of(islands_, [&](const auto& entry) {
    return entry.first.first == run && (is_busy(entry.second) || !entry.second->finished());
  });
}

void IslandHost::start_ready(const IsAwaited& is_awaited) {
  while (slots_.has_room() && start_one(is_awaited)) {
  }
  note_waiting();
}

/// An island waits while its neighbours' migrants are missing, a slot without work while there is an island left to
/// breed. Returns the time of now.
WaitedShare::Time IslandHost::note_waiting() {
  const WaitedShare::Time now = std::chrono::steady_clock::now();
  bool any_left = false, any_waits = false;
  for (const auto& [place, island] : islands_) {
    const bool busy = is_busy(island);
    if (!busy && island->finished()) continue;
    any_left = true;
    const bool waits = !busy && !island->is_ready(arrived_[place.first]);
    any_waits |= waits;
    island->set_waiting(now, waits);
  }
  const double slots = options_.slots;
  const double idle = std::max(slots - static_cast<double>(busy_.size()), 0.0);
  slots_waited_.set(now, any_left ? idle : 0.0, any_left ? slots : 0.0);
  waits_for_migrants_ = idle > 0.0 && any_waits;
  return now;
}

/// Of the islands whose immigrants are all here, the one that is farthest behind.
std::shared_ptr<HostedIsland> IslandHost::slowest_ready() const {
  std::shared_ptr<HostedIsland> slowest;
  for (const auto& [place, island] : islands_) {
    if (is_busy(island) || island->finished()) continue;  // who is busy must not be looked at
    if (slowest && slowest->epoch() <= island->epoch()) continue;
    if (island->is_ready(arrived_.at(place.first))) slowest = island;
  }
  return slowest;
}

/// The slowest island and those it exchanges migrants with, where as many others are ready as there are slots besides;
/// else the slowest alone, for an epoch.
bool IslandHost::start_one(const IsAwaited& is_awaited) {
  const std::shared_ptr<HostedIsland> slowest = slowest_ready();
  if (!slowest) return false;
  const MigrantStore& arrived = arrived_.at(slowest->run());
  const auto free = free_islands(slowest->run());
  auto linked = linked_with(slowest, free);
  const auto is_besides = [&](const auto& entry) {
    return entry.second->is_ready(arrived) && std::ranges::count(linked, entry.second) == 0;
  };
  const bool together = std::ranges::count_if(free, is_besides) + 1 >= options_.slots;
  if (!together) linked = {slowest};
  std::vector<EpochBatch::Member> members;
  MigrantStore needed;
  for (const auto& island : linked) {
    members.push_back({island, is_awaited(*island)});
    needed.copy(arrived, island->sources(), island->epoch());
  }
  const auto batch = std::make_shared<EpochBatch>(std::move(members), std::move(needed));
  for (const auto& island : linked) busy_[island] = batch;
  slots_.start(batch, [this, batch, budget = together ? options_.batch : kAtOnce] {
    batch->breed(budget, [this] {
      slots_.heartbeat();
      if (options_.after_generation) options_.after_generation();
    });
  });
  return true;
}

/// Of one run, those that no slot is at and that have not bred all their generations.
std::map<IslandKey, std::shared_ptr<HostedIsland>> IslandHost::free_islands(RunId run) const {
  std::map<IslandKey, std::shared_ptr<HostedIsland>> free;
  for (const auto& [place, island] : islands_)
    if (place.first == run && !is_busy(island) && !island->finished()) free[place.second] = island;
  return free;
}

std::shared_ptr<EpochBatch> IslandHost::collect() {
  const auto finished = slots_.finished();
  if (!finished) return nullptr;
  for (const EpochBatch::Member& member : (*finished)->members()) busy_.erase(member.island);
  slots_waited_.add_waited(note_waiting() - (*finished)->ended());
  return *finished;
}

}  // namespace demecal::inline hosting
