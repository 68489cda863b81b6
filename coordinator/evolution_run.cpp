#include "coordinator/evolution_run.hpp"

#include <set>

#include "protocol/faults.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::milliseconds kFarewell{2000};

}  // namespace

EvolutionRun::EvolutionRun(Transport& transport, CalibrationData data, RunObserver& observer)
    : transport_(transport), data_(std::move(data)), observer_(observer), assignment_(islands(data_.archipelago)) {
  for (const IslandKey island : islands(data_.archipelago)) isles_[island];
}

RunResult EvolutionRun::run(const std::atomic<bool>& interrupt, std::chrono::milliseconds worker_patience) {
  using Clock = std::chrono::steady_clock;
  transport_.publish(data_);
  transport_.publish(Control{data_.run, Control::State::running, data_.job});
  Clock::time_point last_worker = Clock::now(), last_tick = last_worker;
  RunEnd end = RunEnd::finished;
  while (!all_finished()) {
    if (const std::optional<Message> message = transport_.receive(kTick)) receive(*message);
    hand_out();
    const Clock::time_point now = Clock::now();
    if (assignment_.has_workers()) last_worker = now;
    if (now - last_tick >= kTick) {
      observer_.on_tick();
      last_tick = now;
    }
    if (interrupt) end = RunEnd::interrupted;
    if (now - last_worker >= worker_patience) end = RunEnd::no_worker;
    if (end != RunEnd::finished) break;
  }
  transport_.publish(
      Control{data_.run, end == RunEnd::finished ? Control::State::finished : Control::State::cancelled, data_.job});
  transport_.flush(kFarewell);
  return gather(end);
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
  if (status.only_run != 0 && status.only_run != data_.run) return;
  if (status.leaving) {
    lose(status.worker);
    return;
  }
  assignment_.add_worker(status.worker, status.slots);
  observer_.on_worker(status);
}

void EvolutionRun::take(const Progress& progress) {
  if (find_fault(progress, data_)) return;
  const bool is_new = isles_.at(progress.island).progress.try_emplace(progress.epoch, progress).second;
  if (is_new) observer_.on_progress(progress);
}

void EvolutionRun::take(const Checkpoint& checkpoint) {
  if (find_fault(checkpoint, data_)) return;
  Isle& isle = isles_.at(checkpoint.island);
  // Whoever computed it: the state after an epoch is the same from every attempt.
  if (checkpoint.state.epoch <= isle.reached.epoch) return;
  isle.reached = checkpoint.state;
  isle.recent = checkpoint.recent;
}

void EvolutionRun::take(const Outcome& outcome) {
  if (find_fault(outcome, data_)) return;
  Isle& isle = isles_.at(outcome.island);
  if (isle.finished) return;
  isle.finished = true;
  outcomes_[outcome.island] = outcome;
  assignment_.finish(outcome.island);
}

void EvolutionRun::lose(const std::string& worker) {
  assignment_.remove_worker(worker);
  observer_.on_lost(worker);
}

void EvolutionRun::hand_out() {
  for (const Move& move : assignment_.balance()) {
    Isle& isle = isles_.at(move.island);
    transport_.publish(IslandTask{data_.run, move.island, ++isle.attempt, move.worker, isle.reached, isle.recent});
  }
}

bool EvolutionRun::all_finished() const {
  return outcomes_.size() == isles_.size();
}

RunResult EvolutionRun::gather(RunEnd end) const {
  RunResult result{.end = end, .fronts = {}, .history = {}};
  std::set<std::string> workers;
  for (const auto& [island, isle] : isles_) {
    const auto outcome = outcomes_.find(island);
    const bool done = outcome != outcomes_.end();
    result.fronts[island] = done ? outcome->second.front : isle.reached.front;
    result.generations += done ? outcome->second.generations : isle.reached.generation;
    result.evaluations += done ? outcome->second.evaluations : isle.reached.evaluations;
    result.migrations += done ? outcome->second.migrants_taken : isle.reached.migrants_taken;
    if (done) workers.insert(outcome->second.worker);
    for (const auto& [epoch, progress] : isle.progress) result.history.push_back(progress);
  }
  result.workers = workers.size();
  return result;
}

}  // namespace demecal
