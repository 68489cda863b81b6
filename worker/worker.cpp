#include "worker/worker.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/faults.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kBeat = kLease / 5, kLeastBeat = kLease / 10;
constexpr std::chrono::milliseconds kFarewell{1000}, kAtOnce{0};
constexpr std::chrono::milliseconds kAnnouncement{1000};
constexpr std::size_t kMostWaitingTasks = 65536, kMostEnded = 4096, kMostNamed = 1024;

constexpr const char* kNotGiven = "migrants of an island that no task gives it";

std::string coordinator_of(RunId run) {
  return "the coordinator of run " + std::to_string(run);
}

}  // namespace

Worker::Worker(Transport& transport, const WorkerOptions& options)
    : transport_(transport), options_(options), slots_(options.slots, [&transport] { transport.wake(); }) {}

void Worker::serve(const std::atomic<bool>& stop) {
  announce(false);
  while (!stop && (options_.only_run == 0 || !ended_.contains(options_.only_run))) {
    keep_alive();
    if (const std::optional<Message> message = transport_.receive(kBeat)) receive(*message);
    while (const auto tenancy = slots_.finished()) finish(*tenancy);
    start_ready();
  }
  hand_all_over();
  announce(true);
  transport_.flush(kFarewell);
}

void Worker::receive(const Message& message) {
  if (const auto* data = std::get_if<CalibrationData>(&message)) take(*data);
  if (const auto* task = std::get_if<IslandTask>(&message)) take(*task);
  if (const auto* migrants = std::get_if<Migrants>(&message)) take(*migrants);
  if (const auto* control = std::get_if<Control>(&message)) take(*control);
}

void Worker::take(const CalibrationData& data) {
  if (ended_.contains(data.run) || runs_.contains(data.run)) return;
  if (options_.only_run != 0 && data.run != options_.only_run) return;
  if (const Fault fault = find_fault(data)) return transport_.drop(coordinator_of(data.run), *fault);
  runs_[data.run] = std::make_shared<RunData>(RunData{data});
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
    return transport_.drop(coordinator_of(task.run), *fault);
  }
  name(task);
  Holder& holder = holders_[place];
  if (task.attempt <= holder.attempt) return;
  holder = {task.attempt, task.worker};
  if (task.worker == options_.name) return begin(task);
  hand_over(place);
  reach(place);
}

/// Whoever goes on with the island need not breed again what this worker has bred.
void Worker::hand_over(const Place& place) {
  const auto held = tenancies_.extract(place);
  if (!held.empty() && !busy_.contains(held.mapped())) tell_all(*held.mapped());
}

void Worker::tell_all(Tenancy& tenancy) {
  if (!tenancy.has_bred()) return;
  if (auto progress = tenancy.due_progress(options_.name, kAtOnce)) transport_.publish(std::move(*progress));
  transport_.publish(tenancy.checkpoint(options_.name));
}

void Worker::hand_all_over() {
  while (!tenancies_.empty()) hand_over(Place(tenancies_.begin()->first));
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
  if (options_.only_run != 0 && task.run != options_.only_run) return;
  if (waiting_tasks_ >= kMostWaitingTasks) return transport_.drop(coordinator_of(task.run), "a task without data");
  const auto [waiting, is_first] = waiting_[task.run].try_emplace(task.island, task);
  if (is_first) ++waiting_tasks_;
  if (!is_first && waiting->second.attempt < task.attempt) waiting->second = task;
}

/// Whoever was given an island, now or before, may send its migrants: those of an epoch are the same from each.
void Worker::name(const IslandTask& task) {
  std::set<std::string>& named = named_[{task.run, task.island}];
  if (named.size() >= kMostNamed || !named.insert(task.worker).second) return;
  for (const Migrants& migrants : unproven_.take(task.worker, task.run, task.island)) take(migrants);
}

void Worker::begin(const IslandTask& task) {
  const auto tenancy = std::make_shared<Tenancy>(runs_.at(task.run), task);
  tenancies_[{task.run, task.island}] = tenancy;
  for (const IslandKey& source : tenancy->sources())
    if (is_elsewhere(task.run, source)) transport_.follow_migrants(source.joint);
  for (const IslandKey& consumer : tenancy->consumers())
    if (is_elsewhere(task.run, consumer)) transport_.follow_migrants(task.island.joint);
  for (const Migrants& migrants : task.recent) inboxes_[task.run].put(migrants);
  tenancy->send_all_recent();
  send_migrants(*tenancy);
  // Whoever bred its last generation may have died before it could say so.
  if (tenancy->finished()) transport_.publish(tenancy->outcome(options_.name));
}

/// Only where a neighbour is with another worker: the others find them in the inbox.
void Worker::send_migrants(Tenancy& tenancy) {
  const auto is_far = [&](const IslandKey& consumer) { return is_elsewhere(tenancy.run(), consumer); };
  if (std::ranges::none_of(tenancy.consumers(), is_far)) return;
  for (Migrants& migrants : tenancy.unsent()) {
    migrants.worker = options_.name;
    transport_.publish(migrants);
  }
}

bool Worker::is_elsewhere(RunId run, IslandKey island) const {
  const auto holder = holders_.find({run, island});
  return holder != holders_.end() && holder->second.worker != options_.name;
}

/// Not from anybody: a forged emigration would change the run, since the first of an epoch is taken. A worker that the
/// coordinator gave the island can still lie; certificates keep out whom one does not trust.
void Worker::take(const Migrants& migrants) {
  if (ended_.contains(migrants.run)) return;
  if (options_.only_run != 0 && migrants.run != options_.only_run) return;
  const auto run = runs_.find(migrants.run);
  const auto named = named_.find({migrants.run, migrants.island});
  if (run == runs_.end() || named == named_.end() || !named->second.contains(migrants.worker)) {
    if (!unproven_.put(migrants)) transport_.drop(migrants.worker, kNotGiven);
    return;
  }
  if (const Fault fault = find_fault(migrants, run->second->data)) return transport_.drop(migrants.worker, *fault);
  inboxes_[migrants.run].put(migrants);
}

void Worker::take(const Control& control) {
  if (control.state == Control::State::running) return;
  if (control.state == Control::State::cancelled)
    for (const auto& [place, tenancy] : tenancies_)
      if (place.first == control.run && !busy_.contains(tenancy)) tell_all(*tenancy);
  if (ended_.insert(control.run).second) ended_in_order_.push_back(control.run);
  if (ended_in_order_.size() > kMostEnded) {
    ended_.erase(ended_in_order_.front());
    ended_in_order_.pop_front();
  }
  forget_run(control.run);
}

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
    tenancy->set_waiting(now, !busy && !tenancy->is_ready(inboxes_[place.first]));
  }
  const double slots = options_.slots;
  const double idle = std::max(slots - static_cast<double>(busy_.size()), 0.0);
  slots_waited_.set(now, any_left ? idle : 0.0, any_left ? slots : 0.0);
  return now;
}

/// Of the islands whose immigrants are all here, the one that is farthest behind.
bool Worker::start_one() {
  std::shared_ptr<Tenancy> slowest;
  for (const auto& [place, tenancy] : tenancies_) {
    if (busy_.contains(tenancy) || tenancy->finished()) continue;  // who is busy must not be looked at
    if (slowest && slowest->epoch() <= tenancy->epoch()) continue;
    if (tenancy->is_ready(inboxes_[place.first])) slowest = tenancy;
  }
  if (!slowest) return false;
  busy_.insert(slowest);
  slots_.start(slowest, [this, slowest, arrived = slowest->immigrants(inboxes_[slowest->run()])] {
    slowest->run_epoch(arrived, [this] {
      slots_.beat();
      if (options_.after_generation) options_.after_generation();
    });
  });
  return true;
}

void Worker::finish(const std::shared_ptr<Tenancy>& done) {
  busy_.erase(done);
  slots_waited_.add_waited(note_waiting() - done->epoch_ended());
  const Place place{done->run(), done->island()};
  const auto found = tenancies_.find(place);
  if (found == tenancies_.end() || found->second != done) {
    // Given to another worker meanwhile: it need not breed this epoch again.
    if (is_elsewhere(place.first, place.second)) tell_all(*done);
    return;
  }
  Tenancy& tenancy = *done;
  inboxes_[place.first].put(tenancy.last_migrants());
  send_migrants(tenancy);
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

/// Longer where a slot has many islands, which share what checkpoints may cost.
std::chrono::milliseconds Worker::checkpoint_interval() const {
  constexpr std::size_t kIslandsOfInterval = 3;
  return options_.checkpoint_interval *
         std::max<std::size_t>(1, tenancies_.size() / options_.slots / kIslandsOfInterval);
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
  std::erase_if(holders_, of_run);
  runs_.erase(run);
  inboxes_.erase(run);
  if (const auto waiting = waiting_.extract(run)) waiting_tasks_ -= waiting.mapped().size();
  // Who held an island before this worker came is not known here: nobody is accused.
  std::set<std::string> named;
  for (const auto& [place, workers] : named_)
    if (place.first == run) named.insert(workers.begin(), workers.end());
  std::erase_if(named_, of_run);
  for (const auto& [worker, count] : unproven_.forget(run)) {
    for (std::size_t i = 0; i < count && !named.contains(worker); ++i) transport_.drop("", kNotGiven);
  }
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
