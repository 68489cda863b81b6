#include "coordinator/evolution_run.hpp"

#include "protocol/faults.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kFarewell{2000};
/// How long what the last holder of an island still had to tell may be on its way.
constexpr std::chrono::milliseconds kBelated{500};

}  // namespace

EvolutionRun::EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer)
    : EvolutionRun(transport, RunState(std::move(data)), observer) {}

EvolutionRun::EvolutionRun(Transport& transport, RunState state, RunObserver& observer)
    : transport_(transport),
      state_(std::move(state)),
      observer_(observer),
      assignment_(islands(state_.data().archipelago)) {
  for (const Outcome& outcome : state_.outcomes()) assignment_.finish(outcome.island);
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
  RunResult result = state_.result(how);
  result.waited_share = std::move(waited_share_);
  return result;
}

RunEnd EvolutionRun::work(const std::atomic<bool>& interrupt, RunPatience patience) {
  Clock::time_point last_worker = Clock::now(), last_tick = last_worker;
  last_news_ = last_worker;
  while (!state_.all_finished()) {
    if (const std::optional<Message> message = transport_.receive(kTick)) receive(*message);
    hand_out();
    const Clock::time_point now = Clock::now();
    if (assignment_.has_workers()) last_worker = now;
    if (now - last_tick >= kTick) {
      give_again();
      observer_.on_tick();
      last_tick = now;
    }
    if (interrupt) return RunEnd::interrupted;
    if (now - last_worker >= patience.worker) return RunEnd::no_worker;
    if (now - last_news_ >= patience.news && state_.any_out_of_reach()) return RunEnd::stuck;
  }
  return RunEnd::finished;
}

void EvolutionRun::end(Control::State state) {
  transport_.publish(Control{state_.data().run, state, state_.data().job});
  transport_.flush(kFarewell);
}

void EvolutionRun::receive(const Message& message) {
  if (const auto* status = std::get_if<WorkerStatus>(&message)) take(*status);
  if (const auto* progress = std::get_if<Progress>(&message)) take(*progress);
  if (const auto* checkpoint = std::get_if<Checkpoint>(&message)) take(*checkpoint);
  if (const auto* outcome = std::get_if<Outcome>(&message)) take(*outcome);
  if (const auto* lost = std::get_if<WorkerLost>(&message)) lose(lost->worker);
}

void EvolutionRun::take(const WorkerStatus& status) {
  if (find_fault(status)) return;
  if (status.only_run != 0 && status.only_run != state_.data().run) return;
  waited_share_[status.worker] = status.waited_share;
  if (status.leaving) {
    lose(status.worker);
    return;
  }
  assignment_.add_worker(status.worker, status.slots);
  observer_.on_worker(status);
}

void EvolutionRun::take(const Progress& progress) {
  if (!state_.take(progress)) return;
  last_news_ = Clock::now();
  observer_.on_progress(progress);
}

void EvolutionRun::take(const Checkpoint& checkpoint) {
  const auto given = given_.find(checkpoint.island);
  if (given != given_.end() && given->second.attempt == checkpoint.attempt) given->second.answered = true;
  if (!state_.take(checkpoint)) return;
  last_news_ = Clock::now();
  observer_.on_checkpoint(checkpoint);
}

void EvolutionRun::take(const Outcome& outcome) {
  if (!state_.take(outcome)) return;
  last_news_ = Clock::now();
  assignment_.finish(outcome.island);
  observer_.on_outcome(outcome);
}

void EvolutionRun::lose(const std::string& worker) {
  assignment_.remove_worker(worker);
  observer_.on_lost(worker);
}

void EvolutionRun::hand_out() {
  for (const Move& move : assignment_.balance()) give(move.island, move.worker);
}

void EvolutionRun::give(IslandKey island, const std::string& worker) {
  const IslandTask task = state_.task(island, given_[island].attempt + 1, worker);
  given_[island] = {worker, task.attempt, task.start.epoch, Clock::now(), false};
  transport_.publish(task);
}

/// An island may have been farther than was known when it was given away, and its neighbours so much farther that they
/// have forgotten the migrants it would need from there on: its holder is told where to go on instead.
void EvolutionRun::give_again() {
  for (const auto& [island, given] : given_) {
    if (given.answered || Clock::now() - given.moment < kBelated) continue;
    if (assignment_.holder(island) != given.worker || state_.epoch(island) <= given.epoch) continue;
    give(island, std::string(given.worker));
  }
}

}  // namespace demecal
