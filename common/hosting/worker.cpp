#include "hosting/worker.hpp"

#include <algorithm>
#include <memory>
#include <ratio>
#include <set>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/faults.hpp"
#include "transport/participants.hpp"

namespace demecal::inline hosting {
namespace {

constexpr std::chrono::milliseconds kHeartbeat = kLease / 5, kLeastHeartbeat = kLease / 10;
constexpr std::chrono::milliseconds kShutdownTimeout{1000}, kBatchTimeout{200}, kIdleWait{10};
constexpr std::chrono::milliseconds kReportDelay{100};  // while islands wait for migrants
constexpr std::chrono::milliseconds kAnnouncement{1000}, kIdleAfterRuns{1000};
constexpr std::size_t kMostEarlyTasks = 65536, kMostEnded = 4096;

constexpr const char* kNotAssigned = "migrants of an island that no task gives it";

std::string coordinator_of(RunId run) {
  return "the coordinator of run " + std::to_string(run);
}

}  // namespace

Worker::Worker(Transport& transport, const WorkerOptions& options)
    : transport_(transport),
      options_(options),
      host_({.slots = options.slots, .batch = options.batch, .after_generation = options.after_generation},
            [&transport] { transport.wake(); }) {}

void Worker::serve(const std::atomic<bool>& stop) {
  announce(false);
  while (!stop) {
    keep_alive();
    if (const std::optional<Message> message = transport_.receive(reports_.empty() ? kHeartbeat : kIdleWait))
      receive(*message);
    while (const auto batch = host_.collect()) report(*batch);
    host_.start_ready([this](const HostedIsland& island) { return is_awaited_elsewhere(island); });
    publish_due_reports();
  }
  hand_over_all();
  finish_batches();
  announce(true);
  transport_.flush(kShutdownTimeout);
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
  if (ended_.contains(data.run) || host_.data(data.run) != nullptr) return;
  if (!serves(data.run)) return;
  if (const Fault fault = find_fault(data)) return transport_.reject(coordinator_of(data.run), *fault);
  host_.begin_run(data);
  const auto early = early_tasks_.extract(data.run);
  if (early.empty()) return;
  early_count_ -= early.mapped().size();
  for (const auto& [island, task] : early.mapped()) take(task);
}

void Worker::take(const IslandTask& task) {
  const IslandOfRun place{task.run, task.island};
  if (ended_.contains(task.run)) return;
  const CalibrationData* data = host_.data(task.run);
  if (data == nullptr) return keep_for_later(task);
  if (const Fault fault = find_fault(task, *data)) return transport_.reject(coordinator_of(task.run), *fault);
  if (owners_.add(task))
    for (const Migrants& migrants : unverified_.take(task.worker, task.run, task.island)) take(migrants);
  if (!owners_.assign(task)) return;
  if (task.worker == options_.name) return begin(task);
  hand_over(place);
  exchange_with_new_owner(place);
}

/// Whoever goes on with the island need not breed again what this worker has bred.
void Worker::hand_over(const IslandOfRun& place) {
  if (const auto island = host_.release(place)) publish_state(*island);
}

void Worker::publish_state(HostedIsland& island) {
  publish_reports();
  if (!island.has_progressed()) return;
  if (auto progress = island.due_progress(options_.name, kAtOnce)) transport_.publish(std::move(*progress));
  transport_.publish(island.checkpoint(options_.name));
}

/// Of the islands here that are of the run, one.
std::optional<IslandOfRun> Worker::any_island_of(RunId run) const {
  const auto first = host_.islands().lower_bound({run, {}});
  return first != host_.islands().end() && first->first.first == run ? std::optional(first->first) : std::nullopt;
}

void Worker::hand_over_all() {
  while (!host_.islands().empty()) hand_over(IslandOfRun(host_.islands().begin()->first));
}

/// They end soon, but a slot that hangs is not waited for long.
void Worker::finish_batches() {
  const auto end = std::chrono::steady_clock::now() + kBatchTimeout;
  while (!host_.is_idle() && std::chrono::steady_clock::now() < end) {
    if (const auto batch = host_.collect()) {
      report(*batch);
    } else {
      transport_.receive(kIdleWait);  // or until a slot wakes it
    }
  }
}

/// Joins the migrants' topics that the owner of an island and this worker's islands need, and sends what it may lack.
void Worker::exchange_with_new_owner(const IslandOfRun& place) {
  const auto [run, key] = place;
  for (const auto& [own, island] : host_.islands()) {
    if (own.first != run) continue;
    if (std::ranges::count(island->sources(), key) > 0) transport_.follow_migrants(key.joint);
    if (std::ranges::count(island->consumers(), key) == 0) continue;
    transport_.offer_migrants(own.second.joint);
    island->send_all_recent();
    if (!host_.is_busy(island)) send_migrants(*island);
  }
}

void Worker::keep_for_later(const IslandTask& task) {
  if (!serves(task.run)) return;
  if (early_count_ >= kMostEarlyTasks) return transport_.reject(coordinator_of(task.run), "a task without data");
  const auto [early, is_first] = early_tasks_[task.run].try_emplace(task.island, task);
  if (is_first) ++early_count_;
  if (!is_first && early->second.attempt < task.attempt) early->second = task;
}

void Worker::begin(const IslandTask& task) {
  const auto island = host_.host(task);
  for (const IslandKey& source : island->sources())
    if (is_elsewhere(task.run, source)) transport_.follow_migrants(source.joint);
  for (const IslandKey& consumer : island->consumers())
    if (is_elsewhere(task.run, consumer)) transport_.offer_migrants(task.island.joint);
  island->send_all_recent();
  send_migrants(*island);
  // Whoever bred its last generation may have died before it could say so.
  if (island->finished()) transport_.publish(island->outcome(options_.name));
}

/// Only where a neighbour is with another worker: the others find them among what arrived.
void Worker::send_migrants(HostedIsland& island) {
  if (!is_awaited_elsewhere(island)) return;
  for (Migrants& migrants : island.unsent()) {
    migrants.worker = options_.name;
    transport_.publish(migrants);
  }
}

bool Worker::is_elsewhere(RunId run, IslandKey island) const {
  return owners_.is_elsewhere({run, island}, options_.name);
}

bool Worker::is_awaited_elsewhere(const HostedIsland& island) const {
  return std::ranges::any_of(island.consumers(),
                             [&](const IslandKey& consumer) { return is_elsewhere(island.run(), consumer); });
}

/// Not from anybody: a forged emigration would change the run, since the first of an epoch is taken. Whoever was given
/// the island, now or before, may send: migrants of an epoch are the same from each. A worker that the coordinator gave
/// the island can still lie; certificates keep out whom one does not trust.
void Worker::take(const Migrants& migrants) {
  if (ended_.contains(migrants.run)) return;
  if (!serves(migrants.run)) return;
  const CalibrationData* data = host_.data(migrants.run);
  if (data == nullptr || !owners_.was_assigned({migrants.run, migrants.island}, migrants.worker)) {
    if (!unverified_.put(migrants)) transport_.reject(migrants.worker, kNotAssigned);
    return;
  }
  if (const Fault fault = find_fault(migrants, *data)) return transport_.reject(migrants.worker, *fault);
  host_.put(migrants);
}

void Worker::take(const Control& control) {
  if (control.state == Control::State::running) return;
  publish_reports();
  if (ended_.try_emplace(control.run, control.state).second) ended_in_order_.push_back(control.run);
  if (control.state == Control::State::cancelled)
    while (const std::optional<IslandOfRun> place = any_island_of(control.run)) hand_over(*place);
  if (ended_in_order_.size() > kMostEnded) {
    ended_.erase(ended_in_order_.front());
    ended_in_order_.pop_front();
  }
  forget_run(control.run);
}

void Worker::report(const EpochBatch& batch) {
  for (const EpochBatch::Member& member : batch.members()) report(member);
}

/// What a batch made of one of its islands.
void Worker::report(const EpochBatch::Member& member) {
  HostedIsland& island = *member.island;
  const IslandOfRun place{island.run(), island.island()};
  const auto hosted = host_.find(place);
  if (hosted != member.island) {
    // Handed over meanwhile: whoever goes on with it need not breed this again.
    if (!hosted && !is_finished(place.first)) publish_state(island);
    return;
  }
  for (const Migrants& migrants : island.recent())
    if (migrants.epoch > member.first_epoch) host_.put(migrants);
  const bool has_progressed = island.epoch() > member.first_epoch;
  if (has_progressed || island.is_sending_all_recent()) send_migrants(island);
  if (!has_progressed) return;
  auto checkpoint = island.due_checkpoint(options_.name, checkpoint_interval());
  // Who goes on from a checkpoint reports nothing of the epochs before it.
  auto progress = island.due_progress(options_.name, checkpoint ? kAtOnce : options_.progress_interval);
  if (reports_.empty()) reports_due_ = std::chrono::steady_clock::now() + kReportDelay;
  if (progress) reports_.emplace_back(std::move(*progress));
  if (checkpoint) reports_.emplace_back(std::move(*checkpoint));
  if (!island.finished()) return;
  publish_reports();
  if (!host_.has_unfinished(place.first)) announce(false);  // the share it waited, before the run can be over
  transport_.publish(island.outcome(options_.name));
}

/// Migrants come first: while islands wait for some, here or with others on the same processors, reports wait, too.
void Worker::publish_due_reports() {
  if (std::chrono::steady_clock::now() >= reports_due_ || !host_.waits_for_migrants()) publish_reports();
}

void Worker::publish_reports() {
  for (; !reports_.empty(); reports_.pop_front()) transport_.publish(reports_.front());
}

bool Worker::is_finished(RunId run) const {
  return ended_.contains(run) && ended_.at(run) == Control::State::finished;
}

/// Longer where a slot has many islands, which share what checkpoints may cost.
std::chrono::milliseconds Worker::checkpoint_interval() const {
  constexpr std::size_t kIslandsOfInterval = 3;
  return options_.checkpoint_interval *
         std::max<std::size_t>(1, host_.islands().size() / options_.slots / kIslandsOfInterval);
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
                                  .waited_share = host_.waited_share(announced_)});
}

void Worker::forget_run(RunId run) {
  host_.forget_run(run);
  if (const auto early = early_tasks_.extract(run)) early_count_ -= early.mapped().size();
  // Who owned an island before this worker came is not known here: nobody is accused.
  const std::set<std::string> assigned = owners_.forget(run);
  for (const auto& [worker, count] : unverified_.forget(run)) {
    for (std::size_t i = 0; i < count && !assigned.contains(worker); ++i) transport_.reject("", kNotAssigned);
  }
  idle_since_ = std::chrono::steady_clock::now();
}

/// What is to be done between runs must not take the time of the next one, which may follow at once.
void Worker::note_idleness(WaitedShare::Time now) {
  if (!idle_since_) return;
  if (!host_.islands().empty() || !host_.is_idle()) {
    idle_since_ = now;
  } else if (now - *idle_since_ >= kIdleAfterRuns) {
    idle_since_.reset();
    if (options_.after_runs) options_.after_runs();
  }
}

void Worker::keep_alive() {
  const WaitedShare::Time now = std::chrono::steady_clock::now();
  if (now - asserted_ < kLeastHeartbeat) return;
  asserted_ = now;
  note_idleness(now);
  const std::uint64_t heartbeats = host_.heartbeats();
  if (!host_.is_idle() && heartbeats == heartbeats_seen_) return;  // a slot that hangs must not look alive
  heartbeats_seen_ = heartbeats;
  transport_.assert_alive();
  if (now - announced_ >= kAnnouncement) announce(false);
}

}  // namespace demecal::inline hosting
