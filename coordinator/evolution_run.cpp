#include "coordinator/evolution_run.hpp"

#include <algorithm>
#include <cstdio>

#include "protocol/faults.hpp"
#include "transport/participants.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kFarewell{2000};
/// How long what the last holder of an island still had to tell may be on its way.
constexpr std::chrono::milliseconds kBelated{500};
constexpr int kMostDoublings = 10;

}  // namespace

EvolutionRun::EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer)
    : EvolutionRun(transport, RunState(std::move(data)), observer) {}

EvolutionRun::EvolutionRun(Transport& transport, RunState state, RunObserver& observer,
                           const std::map<std::string, WorkerStatus>& present)
    : transport_(transport),
      state_(std::move(state)),
      observer_(observer),
      assignment_(islands(state_.data().archipelago)),
      diligence_(state_.data().archipelago, Clock::now()) {
  for (const Checkpoint& known : state_.checkpoints())
    diligence_.reached(known.island, known.state.epoch, Clock::now());
  for (const Outcome& outcome : state_.outcomes()) {
    assignment_.finish(outcome.island);
    diligence_.finished(outcome.island);
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
  if (how == RunEnd::interrupted) hear_last_words();
  RunResult result = state_.result(how);
  count_strangers();
  result.present = std::move(present_);
  result.waited_share = std::move(waited_share_);
  result.dropped = transport_.rejected();
  return result;
}

RunEnd EvolutionRun::work(const std::atomic<bool>& interrupt, RunPatience patience) {
  Clock::time_point last_worker = Clock::now(), last_tick = last_worker;
  last_news_ = last_worker;
  hand_out();
  while (!state_.all_finished() || waits_for_history()) {
    if (const std::optional<Message> message = transport_.receive(kTick)) receive(*message);
    hand_out();
    const Clock::time_point now = Clock::now();
    if (assignment_.has_workers()) last_worker = now;
    if (now - last_tick >= kTick) {
      give_again();
      set_idle_aside(patience.idle);
      take_back(now);
      observer_.on_tick();
      last_tick = now;
    }
    if (interrupt) return RunEnd::interrupted;
    if (now - last_worker >= patience.worker) return RunEnd::no_worker;
    if (now - last_news_ >= patience.news && state_.any_out_of_reach()) return RunEnd::stuck;
  }
  return RunEnd::finished;
}

/// The last figures of an island may come after its outcome; they are worth a moment.
bool EvolutionRun::waits_for_history() {
  return !state_.all_told() && Clock::now() - last_news_ < kBelated;
}

/// Workers tell how far their islands are when a run is cancelled.
void EvolutionRun::hear_last_words() {
  const Clock::time_point end = Clock::now() + kBelated;
  while (Clock::now() < end) {
    const std::optional<Message> message = transport_.receive(kTick);
    if (!message) return;
    receive(*message);
  }
}

void EvolutionRun::end(Control::State state) {
  transport_.publish(Control{state_.data().run, state, state_.data().job});
  if (state != Control::State::finished) transport_.flush(kFarewell);
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
  waited_share_[status.worker] = status.waited_share;
  if (status.leaving) {
    lose(status.worker);
    return;
  }
  present_[status.worker] = status;
  Aside& aside = aside_[status.worker];
  aside.slots = status.slots;
  if (!aside.now) assignment_.add_worker(status.worker, status.slots);
  observer_.on_worker(status);
}

/// Whether a message of an island makes sense and comes from a worker that was given the island in this run, be it
/// before another: what an earlier holder still has to tell is as good, since the state after an epoch is the same from
/// every attempt. That the message comes from the worker that it names, the transport saw to. Not to be known from here
/// is whether a worker computed what it tells: one that was let in without certificates can lie about its own islands.
template <class IslandMessage>
bool EvolutionRun::is_credible(const IslandMessage& message) {
  constexpr std::size_t kMostStrangers = 1024;
  if (message.run != state_.data().run) {
    const bool is_late = have_one_publisher(message.run, state_.data().run);
    if (!is_late && of_other_runs_.size() < kMostStrangers) ++of_other_runs_[message.worker];
    return false;
  }
  const auto named = named_.find(message.island);
  if (named == named_.end() || !named->second.contains(message.worker)) {
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
  Given& given = given_.at(progress.island);
  if (given.worker == progress.worker && given.epoch < progress.epoch) given.answered = true;
  diligence_.reached(progress.island, progress.epoch, last_news_);
  observer_.on_progress(progress);
}

void EvolutionRun::take(const Checkpoint& checkpoint) {
  if (!is_credible(checkpoint)) return;
  Given& given = given_.at(checkpoint.island);
  if (given.attempt == checkpoint.attempt && given.worker == checkpoint.worker) given.answered = true;
  if (!state_.take(checkpoint)) return;
  last_news_ = Clock::now();
  diligence_.reached(checkpoint.island, checkpoint.state.epoch, last_news_);
  observer_.on_checkpoint(checkpoint);
  if (checkpoint.worker != given.worker && !given.answered) give_again(checkpoint.island);
}

void EvolutionRun::take(const Outcome& outcome) {
  if (!is_credible(outcome) || !state_.take(outcome)) return;
  last_news_ = Clock::now();
  assignment_.finish(outcome.island);
  diligence_.finished(outcome.island);
  observer_.on_outcome(outcome);
}

void EvolutionRun::lose(const std::string& worker) {
  assignment_.remove_worker(worker);
  aside_.erase(worker);
  present_.erase(worker);
  observer_.on_lost(worker);
}

/// Workers that hold an island which lacks nothing and does not get on; never the last one.
void EvolutionRun::set_idle_aside(std::chrono::milliseconds patience) {
  const Clock::time_point now = Clock::now();
  for (const IslandKey island : diligence_.stalled(now, patience)) {
    const std::string worker = assignment_.holder(island);
    if (worker.empty() || assignment_.worker_count() < 2) continue;
    Aside& aside = aside_[worker];
    aside.now = true;
    aside.until = now + patience * (1 << std::min(aside.times++, kMostDoublings));
    assignment_.remove_worker(worker);
    std::fprintf(stderr, "worker %s has stalled; its islands are being reassigned\n", worker.c_str());
  }
}

/// Another chance, the later the more often it was idle; at once where nobody else is left.
void EvolutionRun::take_back(Clock::time_point now) {
  for (auto& [worker, aside] : aside_) {
    if (!aside.now || (now < aside.until && assignment_.has_workers())) continue;
    aside.now = false;
    assignment_.add_worker(worker, aside.slots);
  }
}

/// Workers tell of all the runs that they serve. Who tells of others and never said that it is a worker is a stranger.
void EvolutionRun::count_strangers() {
  for (const auto& [worker, count] : of_other_runs_) {
    if (waited_share_.contains(worker)) continue;
    for (std::uint64_t i = 0; i < count; ++i) transport_.reject(worker, "it tells of another run");
  }
}

void EvolutionRun::hand_out() {
  for (const Move& move : assignment_.balance()) give(move.island, move.worker);
}

void EvolutionRun::give(IslandKey island, const std::string& worker) {
  const IslandTask task = state_.task(island, given_[island].attempt + 1, worker);
  given_[island] = {worker, task.attempt, task.start.epoch, Clock::now(), false};
  named_[island].insert(worker);
  diligence_.given(island, task.start.epoch, given_[island].moment);
  transport_.publish(task);
}

void EvolutionRun::give_again() {
  for (const auto& [island, given] : given_)
    if (!given.answered && Clock::now() - given.moment >= kBelated) give_again(island);
}

/// An island may have been farther than was known when it was given away, and its neighbours so much farther that they
/// have forgotten the migrants it would need from there on: its holder is told where to go on instead.
void EvolutionRun::give_again(IslandKey island) {
  const Given& given = given_.at(island);
  if (assignment_.holder(island) != given.worker || state_.epoch(island) <= given.epoch) return;
  give(island, std::string(given.worker));
}

}  // namespace demecal
