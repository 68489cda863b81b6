#include "worker/worker.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/faults.hpp"
#include "transport/participants.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kBeat = kLease / 5, kLeastBeat = kLease / 10;
constexpr std::chrono::milliseconds kFarewell{1000}, kLastSpells{200}, kTick{10};
constexpr std::chrono::milliseconds kAnnouncement{1000};
constexpr std::size_t kMostWaitingTasks = 65536, kMostEnded = 4096;

constexpr const char* kNotGiven = "migrants of an island that no task gives it";

std::string coordinator_of(RunId run) {
  return "the coordinator of run " + std::to_string(run);
}

}  // namespace

Worker::Worker(Transport& transport, const WorkerOptions& options)
    : transport_(transport), options_(options), slots_(options.slots, [&transport] { transport.wake(); }) {}

void Worker::serve(const std::atomic<bool>& stop) {
  announce(false);
  while (!stop) {
    keep_alive();
    if (const std::optional<Message> message = transport_.receive(kBeat)) receive(*message);
    while (const auto spell = slots_.finished()) finish(**spell);
    start_ready();
  }
  hand_all_over();
  collect_spells();
  announce(true);
  transport_.flush(kFarewell);
}

bool Worker::serves(RunId run) const {
  return options_.only_run == 0 || have_one_publisher(options_.only_run, run);
}

void Worker::receive(const Message& message) {
  if (const auto* data = std::get_if<CalibrationData>(&message)) take(*data);
  if (const auto* task = std::get_if<IslandTask>(&message)) take(*task);
  if (const auto* migrants = std::get_if<Migrants>(&message)) take(*migrants);
  if (const auto* control = std::get_if<Control>(&message)) take(*control);
}

void Worker::take(const CalibrationData& data) {
  if (ended_.contains(data.run) || runs_.contains(data.run)) return;
  if (!serves(data.run)) return;
  if (const Fault fault = find_fault(data)) return transport_.reject(coordinator_of(data.run), *fault);
  runs_[data.run] = std::make_shared<RunData>(RunData{data});
  arrived_[data.run];
  const auto early = waiting_.extract(data.run);
  if (early.empty()) return;
  waiting_tasks_ -= early.mapped().size();
  for (const auto& [island, task] : early.mapped()) take(task);
}

void Worker::take(const IslandTask& task) {
  const Place place{task.run, task.island};
  if (ended_.contains(task.run)) return;
  const auto run = runs_.find(task.run);
  if (run == runs_.end()) return keep_for_later(task);
  if (const Fault fault = find_fault(task, run->second->data)) {
    return transport_.reject(coordinator_of(task.run), *fault);
  }
  if (holders_.name(task))
    for (const Migrants& migrants : unproven_.take(task.worker, task.run, task.island)) take(migrants);
  if (!holders_.give(task)) return;
  if (task.worker == options_.name) return begin(task);
  hand_over(place);
  reach(place);
}

/// Whoever goes on with the island need not breed again what this worker has bred.
void Worker::hand_over(const Place& place) {
  const auto held = tenancies_.extract(place);
  if (held.empty()) return;
  const auto busy = busy_.find(held.mapped());
  if (busy == busy_.end()) return tell_all(*held.mapped());
  busy->second->end_soon();
}

void Worker::tell_all(Tenancy& tenancy) {
  if (!tenancy.has_bred()) return;
  if (auto progress = tenancy.due_progress(options_.name, kAtOnce)) transport_.publish(std::move(*progress));
  transport_.publish(tenancy.checkpoint(options_.name));
}

/// Of the islands here that are of the run, one.
std::optional<Place> Worker::place_of(RunId run) const {
  const auto first = tenancies_.lower_bound({run, {}});
  return first != tenancies_.end() && first->first.first == run ? std::optional(first->first) : std::nullopt;
}

void Worker::hand_all_over() {
  while (!tenancies_.empty()) hand_over(Place(tenancies_.begin()->first));
}

/// They end soon, but a slot that hangs is not waited for long.
void Worker::collect_spells() {
  const auto end = std::chrono::steady_clock::now() + kLastSpells;
  while (!slots_.is_idle() && std::chrono::steady_clock::now() < end) {
    if (const auto spell = slots_.finished()) {
      finish(**spell);
    } else {
      transport_.receive(kTick);  // or until a slot wakes it
    }
  }
}

/// Joins the migrants' topics that the holder of an island and this worker's islands need, and sends what it may lack.
void Worker::reach(const Place& place) {
  const auto [run, island] = place;
  for (const auto& [own, tenancy] : tenancies_) {
    if (own.first != run) continue;
    if (std::ranges::count(tenancy->sources(), island) > 0) transport_.follow_migrants(island.joint);
    if (std::ranges::count(tenancy->consumers(), island) == 0) continue;
    transport_.follow_migrants(own.second.joint);
    tenancy->send_all_recent();
    if (!busy_.contains(tenancy)) send_migrants(*tenancy);
  }
}

void Worker::keep_for_later(const IslandTask& task) {
  if (!serves(task.run)) return;
  if (waiting_tasks_ >= kMostWaitingTasks) return transport_.reject(coordinator_of(task.run), "a task without data");
  const auto [waiting, is_first] = waiting_[task.run].try_emplace(task.island, task);
  if (is_first) ++waiting_tasks_;
  if (!is_first && waiting->second.attempt < task.attempt) waiting->second = task;
}

void Worker::begin(const IslandTask& task) {
  const auto tenancy = std::make_shared<Tenancy>(runs_.at(task.run), task);
  tenancies_[{task.run, task.island}] = tenancy;
  for (const IslandKey& source : tenancy->sources())
    if (is_elsewhere(task.run, source)) transport_.follow_migrants(source.joint);
  for (const IslandKey& consumer : tenancy->consumers())
    if (is_elsewhere(task.run, consumer)) transport_.follow_migrants(task.island.joint);
  for (const Migrants& migrants : task.recent) arrived_[task.run].put(migrants);
  tenancy->send_all_recent();
  send_migrants(*tenancy);
  // Whoever bred its last generation may have died before it could say so.
  if (tenancy->finished()) transport_.publish(tenancy->outcome(options_.name));
}

/// Only where a neighbour is with another worker: the others find them among what arrived.
void Worker::send_migrants(Tenancy& tenancy) {
  if (!is_awaited_elsewhere(tenancy)) return;
  for (Migrants& migrants : tenancy.unsent()) {
    migrants.worker = options_.name;
    transport_.publish(migrants);
  }
}

bool Worker::is_elsewhere(RunId run, IslandKey island) const {
  return holders_.is_elsewhere({run, island}, options_.name);
}

bool Worker::is_awaited_elsewhere(const Tenancy& tenancy) const {
  return std::ranges::any_of(tenancy.consumers(),
                             [&](const IslandKey& consumer) { return is_elsewhere(tenancy.run(), consumer); });
}

/// Not from anybody: a forged emigration would change the run, since the first of an epoch is taken. Whoever was given
/// the island, now or before, may send: migrants of an epoch are the same from each. A worker that the coordinator gave
/// the island can still lie; certificates keep out whom one does not trust.
void Worker::take(const Migrants& migrants) {
  if (ended_.contains(migrants.run)) return;
  if (!serves(migrants.run)) return;
  const auto run = runs_.find(migrants.run);
  if (run == runs_.end() || !holders_.was_given({migrants.run, migrants.island}, migrants.worker)) {
    if (!unproven_.put(migrants)) transport_.reject(migrants.worker, kNotGiven);
    return;
  }
  if (const Fault fault = find_fault(migrants, run->second->data)) return transport_.reject(migrants.worker, *fault);
  arrived_[migrants.run].put(migrants);
}

void Worker::take(const Control& control) {
  if (control.state == Control::State::running) return;
  if (ended_.try_emplace(control.run, control.state).second) ended_in_order_.push_back(control.run);
  if (control.state == Control::State::cancelled)
    while (const std::optional<Place> place = place_of(control.run)) hand_over(*place);
  if (ended_in_order_.size() > kMostEnded) {
    ended_.erase(ended_in_order_.front());
    ended_in_order_.pop_front();
  }
  forget_run(control.run);
}

void Worker::announce(bool leaving) {
  announced_ = std::chrono::steady_clock::now();
  transport_.publish(WorkerStatus{.worker = options_.name,
                                  .host = options_.host,
                                  .process = options_.process,
                                  .slots = options_.slots,
                                  .version = DEMECAL_VERSION,
                                  .leaving = leaving,
                                  .only_run = options_.only_run,
                                  .waited_share = slots_waited_.at(announced_)});
}

void Worker::forget_run(RunId run) {
  const auto of_run = [run](const auto& entry) { return entry.first.first == run; };
  std::erase_if(tenancies_, of_run);
  runs_.erase(run);
  arrived_.erase(run);
  if (const auto waiting = waiting_.extract(run)) waiting_tasks_ -= waiting.mapped().size();
  // Who held an island before this worker came is not known here: nobody is accused.
  const std::set<std::string> named = holders_.forget(run);
  for (const auto& [worker, count] : unproven_.forget(run)) {
    for (std::size_t i = 0; i < count && !named.contains(worker); ++i) transport_.reject("", kNotGiven);
  }
  if (options_.after_run) options_.after_run();
}

void Worker::keep_alive() {
  const WaitedShare::Time now = std::chrono::steady_clock::now();
  if (now - asserted_ < kLeastBeat) return;
  asserted_ = now;
  const std::uint64_t beats = slots_.beats();
  if (!slots_.is_idle() && beats == beats_seen_) return;  // a slot that hangs must not look alive
  beats_seen_ = beats;
  transport_.assert_alive();
  if (now - announced_ >= kAnnouncement) announce(false);
}

}  // namespace demecal
