#include "scheduling/evolution_run.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <variant>
#include <vector>

#include "evolution/island.hpp"
#include "protocol/faults.hpp"
#include "transport/participants.hpp"

namespace demecal::inline scheduling {
namespace {

constexpr std::chrono::milliseconds kRunTick{100}, kNoWait{0};
/// Messages, between two looks at whether the run is to end.
constexpr int kMostWaiting = 1000;
constexpr std::chrono::milliseconds kRunShutdownTimeout{2000};
/// How long what the last owner of an island still had to report may be on its way.
constexpr std::chrono::milliseconds kLateGrace{500};
constexpr std::chrono::milliseconds kDrainTimeout = kLateGrace;
/// An island that takes longer where it is is given to a worker that has less to do.
constexpr std::chrono::milliseconds kWorthMoving{200};

}  // namespace

EvolutionRun::EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer)
    : EvolutionRun(transport, RunState(std::move(data)), observer) {}

EvolutionRun::EvolutionRun(Transport& transport, RunState state, RunObserver& observer,
                           const std::map<std::string, WorkerStatus>& present)
    : transport_(transport),
      state_(std::move(state)),
      observer_(observer),
      assignment_(islands(state_.data().archipelago)),
      stalls_(state_.data().archipelago, Clock::now()),
      pace_(static_cast<std::uint32_t>(state_.data().parameters.number_generations)) {
  for (const Checkpoint& known : state_.checkpoints()) stalls_.reached(known.island, known.state.epoch, Clock::now());
  for (const Outcome& outcome : state_.outcomes()) {
    assignment_.finish(outcome.island);
    stalls_.finished(outcome.island);
  }
  for (const auto& [name, status] : present) take(status);
}

RunResult EvolutionRun::run(const std::atomic<bool>& interrupt, RunPatience patience) {
  transport_.publish(state_.data());
  transport_.publish(Control{state_.data().run, Control::State::running, state_.data().job});
  RunEnd how = RunEnd::finished;
  try {
    how = work(interrupt, patience);
  } catch (...) {
    end(Control::State::cancelled);
    throw;
  }
  end(how == RunEnd::finished ? Control::State::finished : Control::State::cancelled);
  if (how == RunEnd::interrupted) drain_final_messages();
  RunResult result = state_.result(how);
  reject_strangers();
  for (const auto& [name, worker] : workers_) {
    if (worker.status) result.present[name] = *worker.status;
    if (worker.waited_share) result.waited_share[name] = *worker.waited_share;
  }
  result.rejected = transport_.rejected();
  return result;
}

RunEnd EvolutionRun::work(const std::atomic<bool>& interrupt, RunPatience patience) {
  Clock::time_point last_worker = Clock::now(), last_tick = last_worker;
  last_news_ = last_worker;
  assign_islands();
  while (!state_.all_finished() || waits_for_history()) {
    if (const std::optional<Message> message = transport_.receive(kRunTick)) receive(*message);
    receive_waiting();
    assign_islands();
    const Clock::time_point now = Clock::now();
    if (assignment_.has_workers()) last_worker = now;
    if (now - last_tick >= kRunTick) {
      renew_assignments();
      quarantine_stalled(patience.idle);
      end_quarantines(now);
      observer_.on_tick();
      last_tick = now;
    }
    if (interrupt) return RunEnd::interrupted;
    if (now - last_worker >= patience.worker) return RunEnd::no_worker;
    if (now - last_news_ >= patience.news && state_.any_out_of_reach()) return RunEnd::stuck;
  }
  return RunEnd::finished;
}

/// What has come already: the workers among it are to share the islands before any begins with them.
void EvolutionRun::receive_waiting() {
  for (int i = 0; i < kMostWaiting; ++i) {
    const std::optional<Message> message = transport_.receive(kNoWait);
    if (!message) return;
    receive(*message);
  }
}

/// The last figures of an island may come after its outcome; they are worth a moment.
bool EvolutionRun::waits_for_history() {
  return !state_.has_all_progress() && Clock::now() - last_news_ < kLateGrace;
}

/// Workers report how far their islands are when a run is cancelled.
void EvolutionRun::drain_final_messages() {
  const Clock::time_point deadline = Clock::now() + kDrainTimeout;
  while (Clock::now() < deadline) {
    const std::optional<Message> message = transport_.receive(kRunTick);
    if (!message) return;
    receive(*message);
  }
}

void EvolutionRun::end(Control::State state) {
  transport_.publish(Control{state_.data().run, state, state_.data().job});
  if (state != Control::State::finished) transport_.flush(kRunShutdownTimeout);
}

void EvolutionRun::receive(const Message& message) {
  if (const auto* status = std::get_if<WorkerStatus>(&message)) take(*status);
  if (const auto* progress = std::get_if<Progress>(&message)) take(*progress);
  if (const auto* checkpoint = std::get_if<Checkpoint>(&message)) take(*checkpoint);
  if (const auto* outcome = std::get_if<Outcome>(&message)) take(*outcome);
  if (const auto* lost = std::get_if<WorkerLost>(&message)) lose(lost->worker);
}

void EvolutionRun::take(const WorkerStatus& status) {
  if (const Fault fault = find_fault(status)) return transport_.reject(status.worker, *fault);
  if (status.only_run != 0 && !have_one_publisher(status.only_run, state_.data().run)) return;
  KnownWorker& worker = workers_[status.worker];
  worker.waited_share = status.waited_share;
  if (status.leaving) {
    lose(status.worker);
    return;
  }
  worker.status = status;
  if (!worker.quarantine.is_active()) assignment_.add_worker(status.worker, status.slots);
  observer_.on_worker(status);
}

/// Whether a message of an island makes sense and comes from a worker that was assigned the island in this run, be it
/// before another: what an earlier owner still has to report is as good, since the state after an epoch is the same
/// from every attempt. That the message comes from the worker that it names, the transport saw to. Not to be known from
/// here is whether a worker computed what it reports: one that was let in without certificates can lie about its own
/// islands.
template <class IslandMessage>
bool EvolutionRun::is_credible(const IslandMessage& message) {
  if (message.run != state_.data().run) {
    count_foreign(message.worker, message.run);
    return false;
  }
  const auto island = islands_.find(message.island);
  if (island == islands_.end() || !island->second.owners.contains(message.worker)) {
    transport_.reject(message.worker, "it reports on an island it was not assigned");
    return false;
  }
  const Fault fault = find_fault(message, state_.data());
  if (fault) transport_.reject(message.worker, *fault);
  return !fault;
}

void EvolutionRun::take(const Progress& progress) {
  if (!is_credible(progress) || !state_.take(progress)) return;
  last_news_ = Clock::now();
  AssignedIsland& island = islands_.at(progress.island);
  if (island.worker == progress.worker && island.epoch < progress.epoch) island.answered = true;
  stalls_.reached(progress.island, progress.epoch, last_news_);
  pace_.reached(progress.island, progress.generation, last_news_);
  observer_.on_progress(progress);
}

void EvolutionRun::take(const Checkpoint& checkpoint) {
  if (!is_credible(checkpoint)) return;
  AssignedIsland& island = islands_.at(checkpoint.island);
  if (island.attempt == checkpoint.attempt && island.worker == checkpoint.worker) island.answered = true;
  if (!state_.take(checkpoint)) return;
  last_news_ = Clock::now();
  stalls_.reached(checkpoint.island, checkpoint.state.epoch, last_news_);
  observer_.on_checkpoint(checkpoint);
  if (checkpoint.worker != island.worker && !island.answered) renew_assignment(checkpoint.island);
}

void EvolutionRun::take(const Outcome& outcome) {
  if (!is_credible(outcome) || !state_.take(outcome)) return;
  last_news_ = Clock::now();
  assignment_.finish(outcome.island);
  stalls_.finished(outcome.island);
  observer_.on_outcome(outcome);
}

void EvolutionRun::lose(const std::string& worker) {
  assignment_.remove_worker(worker);
  if (const auto known = workers_.find(worker); known != workers_.end()) {
    known->second.quarantine = {};
    known->second.status.reset();
  }
  observer_.on_lost(worker);
}

/// Workers that own an island which lacks nothing and makes no progress; never the last one.
void EvolutionRun::quarantine_stalled(std::chrono::milliseconds patience) {
  const Clock::time_point now = Clock::now();
  for (const IslandKey island : stalls_.stalled(now, patience)) {
    const std::string worker = assignment_.owner(island);
    if (worker.empty() || assignment_.worker_count() < 2) continue;
    workers_[worker].quarantine.begin(now, patience);
    assignment_.remove_worker(worker);
    std::fprintf(stderr, "worker %s has stalled; its islands are being reassigned\n", worker.c_str());
  }
}

/// Another chance, the later the more often it was idle; at once where nobody else is left.
void EvolutionRun::end_quarantines(Clock::time_point now) {
  for (auto& [name, worker] : workers_) {
    const bool is_due = worker.quarantine.is_over(now) || !assignment_.has_workers();
    if (!worker.quarantine.is_active() || !is_due) continue;
    worker.quarantine.end();
    assignment_.add_worker(name, worker.status ? worker.status->slots : 1);
  }
}

/// Messages of another publisher's run; those of an earlier run of this one are only late.
void EvolutionRun::count_foreign(const std::string& worker, RunId run) {
  constexpr std::size_t kMostSenders = 1024;
  if (have_one_publisher(run, state_.data().run) || foreign_senders_ >= kMostSenders) return;
  if (workers_[worker].foreign_messages++ == 0) ++foreign_senders_;
}

/// Workers report on all the runs that they serve. Who reports on others and never said that it is a worker is a
/// stranger.
void EvolutionRun::reject_strangers() {
  for (const auto& [name, worker] : workers_) {
    if (worker.waited_share) continue;
    for (std::uint64_t i = 0; i < worker.foreign_messages; ++i) transport_.reject(name, "it reports on another run");
  }
}

void EvolutionRun::assign_islands() {
  const auto may_move = [this](IslandKey island) { return is_worth_moving(island); };
  for (const Move& move : assignment_.balance(may_move)) assign(move.island, move.worker);
}

/// From a worker that is there: what it is handed over by travels, its new owner begins at an older state, and its
/// neighbours' migrants then travel, too. Not where it is nearly finished, nor where it has hardly arrived.
bool EvolutionRun::is_worth_moving(IslandKey key) const {
  const auto island = islands_.find(key);
  if (island == islands_.end()) return true;
  const Clock::time_point now = Clock::now();
  if (island->second.attempt > 1 && now - island->second.moment < kLateGrace) return false;
  return pace_.left(key, now) >= kWorthMoving;
}

void EvolutionRun::assign(IslandKey key, const std::string& worker) {
  AssignedIsland& island = islands_[key];
  const IslandTask task = state_.task(key, island.attempt + 1, worker);
  island.worker = worker;
  island.attempt = task.attempt;
  island.epoch = task.start.epoch;
  island.moment = Clock::now();
  island.answered = false;
  island.owners.insert(worker);
  stalls_.assigned(key, task.start.epoch, island.moment);
  pace_.assigned(key, task.start.generation, island.moment);
  transport_.publish(task);
}

void EvolutionRun::renew_assignments() {
  for (const auto& [key, island] : islands_)
    if (!island.answered && Clock::now() - island.moment >= kLateGrace) renew_assignment(key);
}

/// An island may have been farther than was known when it was assigned, and its neighbours so much farther that they
/// have forgotten the migrants it would need from there on: its owner is told where to go on instead.
void EvolutionRun::renew_assignment(IslandKey key) {
  const AssignedIsland& island = islands_.at(key);
  if (assignment_.owner(key) != island.worker || state_.epoch(key) <= island.epoch) return;
  assign(key, std::string(island.worker));
}

}  // namespace demecal::inline scheduling
