// What a worker does with its islands: gives them to its slots, and says what these have bred.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "worker/worker.hpp"

namespace demecal {

void Worker::start_ready() {
  while (slots_.has_room() && start_one()) {
  }
  note_waiting();
}

/// An island waits while its neighbours' migrants are missing, a slot without work while there is an island left to
/// breed. Returns the time of now.
WaitedShare::Time Worker::note_waiting() {
  const WaitedShare::Time now = std::chrono::steady_clock::now();
  bool any_left = false;
  for (const auto& [place, tenancy] : tenancies_) {
    const bool busy = busy_.contains(tenancy);
    if (!busy && tenancy->finished()) continue;
    any_left = true;
    tenancy->set_waiting(now, !busy && !tenancy->is_ready(arrived_[place.first]));
  }
  const double slots = options_.slots;
  const double idle = std::max(slots - static_cast<double>(busy_.size()), 0.0);
  slots_waited_.set(now, any_left ? idle : 0.0, any_left ? slots : 0.0);
  return now;
}

/// Of the islands whose immigrants are all here, the one that is farthest behind.
std::shared_ptr<Tenancy> Worker::slowest_ready() const {
  std::shared_ptr<Tenancy> slowest;
  for (const auto& [place, tenancy] : tenancies_) {
    if (busy_.contains(tenancy) || tenancy->finished()) continue;  // who is busy must not be looked at
    if (slowest && slowest->epoch() <= tenancy->epoch()) continue;
    if (tenancy->is_ready(arrived_.at(place.first))) slowest = tenancy;
  }
  return slowest;
}

/// The slowest island and those it exchanges migrants with, where as many others are ready as there are slots besides;
/// else the slowest alone, for an epoch.
bool Worker::start_one() {
  const std::shared_ptr<Tenancy> slowest = slowest_ready();
  if (!slowest) return false;
  const MigrantStore& arrived = arrived_.at(slowest->run());
  const auto free = free_tenancies(slowest->run());
  auto linked = linked_with(slowest, free);
  const auto is_besides = [&](const auto& entry) {
    return entry.second->is_ready(arrived) && std::ranges::count(linked, entry.second) == 0;
  };
  const bool together = std::ranges::count_if(free, is_besides) + 1 >= options_.slots;
  if (!together) linked = {slowest};
  std::vector<Spell::Member> members;
  MigrantStore theirs;
  for (const auto& tenancy : linked) {
    members.push_back({tenancy, is_awaited_elsewhere(*tenancy)});
    theirs.copy(arrived, tenancy->sources(), tenancy->epoch());
  }
  const auto spell = std::make_shared<Spell>(std::move(members), std::move(theirs));
  for (const auto& tenancy : linked) busy_[tenancy] = spell;
  slots_.start(spell, [this, spell, budget = together ? options_.spell : kAtOnce] {
    spell->breed(budget, [this] {
      slots_.beat();
      if (options_.after_generation) options_.after_generation();
    });
  });
  return true;
}

/// Of one run, those that no slot is at and that have not bred all their generations.
std::map<IslandKey, std::shared_ptr<Tenancy>> Worker::free_tenancies(RunId run) const {
  std::map<IslandKey, std::shared_ptr<Tenancy>> free;
  for (const auto& [place, tenancy] : tenancies_)
    if (place.first == run && !busy_.contains(tenancy) && !tenancy->finished()) free[place.second] = tenancy;
  return free;
}

void Worker::finish(const Spell& spell) {
  for (const Spell::Member& member : spell.members()) busy_.erase(member.tenancy);
  slots_waited_.add_waited(note_waiting() - spell.ended());
  for (const Spell::Member& member : spell.members()) finish(member);
}

void Worker::finish(const Spell::Member& member) {
  Tenancy& tenancy = *member.tenancy;
  const Place place{tenancy.run(), tenancy.island()};
  const auto found = tenancies_.find(place);
  if (found == tenancies_.end() || found->second != member.tenancy) {
    // Handed over meanwhile: whoever goes on with it need not breed this again.
    if (found == tenancies_.end() && !is_finished(place.first)) tell_all(tenancy);
    return;
  }
  for (const Migrants& migrants : tenancy.recent())
    if (migrants.epoch > member.began) arrived_[place.first].put(migrants);
  const bool has_got_on = tenancy.epoch() > member.began;
  if (has_got_on || tenancy.owes_all_recent()) send_migrants(tenancy);
  if (!has_got_on) return;
  auto checkpoint = tenancy.due_checkpoint(options_.name, checkpoint_interval());
  // Who goes on from a checkpoint tells nothing of the epochs before it.
  if (auto progress = tenancy.due_progress(options_.name, checkpoint ? kAtOnce : options_.progress_interval))
    transport_.publish(std::move(*progress));
  if (checkpoint) transport_.publish(std::move(*checkpoint));
  if (!tenancy.finished()) return;
  const auto is_left = [&](const auto& entry) {
    return entry.first.first == place.first && (busy_.contains(entry.second) || !entry.second->finished());
  };
  if (std::ranges::none_of(tenancies_, is_left)) announce(false);  // the share it waited, before the run can be over
  transport_.publish(tenancy.outcome(options_.name));
}

bool Worker::is_finished(RunId run) const {
  const auto end = ended_.find(run);
  return end != ended_.end() && end->second == Control::State::finished;
}

/// Longer where a slot has many islands, which share what checkpoints may cost.
std::chrono::milliseconds Worker::checkpoint_interval() const {
  constexpr std::size_t kIslandsOfInterval = 3;
  return options_.checkpoint_interval *
         std::max<std::size_t>(1, tenancies_.size() / options_.slots / kIslandsOfInterval);
}

}  // namespace demecal
