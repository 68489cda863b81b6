#include "coordinator/evolutions.hpp"

#include <algorithm>
#include <utility>

#include "coordinator/progress_display.hpp"
#include "errors/input_error.hpp"
#include "protocol/faults.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kParting{2000};

/// Without a run's number yet.
CalibrationData calibration_data(const Job& job, const std::vector<JointTraining>& trainings,
                                 const EvolutionTerms& terms, bool asynchronous) {
  CalibrationData data;
  data.job = job.name;
  data.seed = terms.seed;
  data.parameters = job.gp;
  data.parameters.number_generations = terms.generations;
  data.parameters.shared_functions = terms.functions;
  data.archipelago.demes_per_joint = job.islands.per_joint;
  data.archipelago.topology = job.islands.topology;
  data.archipelago.migration_interval = job.islands.migration_interval;
  data.archipelago.migrants = job.islands.migrants;
  data.archipelago.between_joints = job.islands.between_joints;
  data.archipelago.asynchronous = asynchronous;
  data.archipelago.replacement = job.islands.replacement;
  data.archipelago.spread = job.islands.spread;
  for (const JointTraining& training : trainings) {
    data.archipelago.joints.push_back(training.joint);
    data.tables.push_back(training.table);
  }
  return data;
}

/// Data that workers would refuse are the user's error.
CalibrationData believable(CalibrationData data) {
  CalibrationData named = data;
  named.run = 1;
  if (const Fault fault = find_fault(named)) {
    throw InputError({}, data.job, "no worker would take this job: " + *fault);
  }
  return data;
}

std::vector<JointCandidates> candidates_of(const std::vector<JointTraining>& trainings, const RunResult& run) {
  std::vector<JointCandidates> candidates;
  for (const JointTraining& training : trainings) {
    ParetoFront front;
    for (const auto& [island, members] : run.fronts) {
      if (island.joint != training.joint) continue;
      for (const Individual& member : members) front.offer(member);
    }
    candidates.push_back({training, front.members()});
  }
  return candidates;
}

/// What happens, told to those who look on, and to chronicle and journal where there are any.
class Recorded : public RunObserver {
 public:
  Recorded(RunObserver& watching, Chronicle* chronicle, RunJournal* journal)
      : watching_(watching), chronicle_(chronicle), journal_(journal) {}
  void on_progress(const Progress& progress) override {
    watching_.on_progress(progress);
    if (chronicle_ != nullptr) chronicle_->heard(progress);
    if (journal_ != nullptr) journal_->on_progress(progress);
  }
  void on_checkpoint(const Checkpoint& checkpoint) override {
    if (journal_ != nullptr) journal_->on_checkpoint(checkpoint);
  }
  void on_outcome(const Outcome& outcome) override {
    if (journal_ != nullptr) journal_->on_outcome(outcome);
  }
  void on_worker(const WorkerStatus& status) override {
    watching_.on_worker(status);
    if (chronicle_ != nullptr) chronicle_->heard(status);
  }
  void on_lost(const std::string& worker) override {
    watching_.on_lost(worker);
    if (chronicle_ != nullptr) chronicle_->heard(WorkerLost{worker});
  }
  void on_tick() override {
    watching_.on_tick();
    if (journal_ != nullptr) journal_->on_tick();
  }

 private:
  RunObserver& watching_;
  Chronicle* chronicle_;
  RunJournal* journal_;
};

Control::State state_told(RunEnd end) {
  return end == RunEnd::finished ? Control::State::finished : Control::State::cancelled;
}

}  // namespace

EvolvedJoints Evolutions::evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) {
  if (trainings.empty()) return {{}, end_ == RunEnd::finished};
  const bool shown = terms.purpose != Purpose::null_distribution;
  RunState state = start_of(believable(calibration_data(job_, trainings, terms, options_.asynchronous)));
  RunResult result = state.all_finished() ? state.result(RunEnd::finished) : run(std::move(state), shown);
  EvolvedJoints evolved{candidates_of(trainings, result), result.end == RunEnd::finished};
  note(result, terms.generations, shown);
  return evolved;
}

RunState Evolutions::start_of(const CalibrationData& data) {
  auto recorded = options_.journal == nullptr ? std::nullopt : options_.journal->recorded(data);
  if (recorded) facts_.resumed = true;
  return recorded ? std::move(*recorded) : RunState(data);
}

/// Goes on from the state as a new run: workers may still be at the one that it comes from, which is over.
RunResult Evolutions::run(RunState state, bool shown) {
  while (true) {
    RunResult result = attempt(state, shown);
    if (result.end != RunEnd::stuck) return result;
    state = RunState(state.data());
    if (options_.journal != nullptr) options_.journal->forget();
  }
}

/// Under a number that shows whose the run is.
RunResult Evolutions::attempt(RunState& state, bool shown) {
  if (!fleet_) fleet_ = make_fleet_();
  Transport& transport = fleet_->transport();
  state.rename(transport.new_run());
  ProgressDisplay display(stderr, state.data(), options_.quiet || !shown);
  for (const Progress& progress : state.progress()) display.on_progress(progress);
  Recorded observer(display, options_.chronicle, options_.journal);
  if (options_.journal != nullptr) {
    options_.journal->begin(state.data());
    for (const RunId left : options_.journal->take_left())
      transport.publish(Control{left, Control::State::cancelled, state.data().job});
  }
  if (options_.chronicle != nullptr) options_.chronicle->run_begins(state.data(), state.progress());
  fleet_->launch(state.data().run);
  RunResult result = EvolutionRun(transport, state, observer, present_).run(interrupt_, options_.patience);
  present_ = std::move(result.present);
  result.dropped -= std::exchange(dropped_, result.dropped);
  if (options_.journal != nullptr) options_.journal->finish();
  display.finish();
  if (options_.chronicle != nullptr) options_.chronicle->run_ends(state_told(result.end));
  if (result.end != RunEnd::finished) let_go();
  return result;
}

void Evolutions::gather() {
  if (fleet_) return;
  fleet_ = make_fleet_();
  fleet_->launch(fleet_->transport().new_run());
}

void Evolutions::dismiss() {
  // Those who served it must hear that the last run is over.
  if (fleet_ && !interrupt_) fleet_->transport().flush(kParting);
  let_go();
}

void Evolutions::let_go() {
  if (!fleet_) return;
  fleet_.reset();
  present_.clear();
  dropped_ = 0;
  if (options_.chronicle != nullptr) options_.chronicle->fleet_ends();
}

void Evolutions::add_effort(std::uint32_t generations, std::uint64_t evaluations) {
  end_ = interrupt_ ? RunEnd::interrupted : RunEnd::finished;
  facts_.generations += generations;
  facts_.evaluations += evaluations;
}

void Evolutions::note(RunResult& result, int generations, bool shown) {
  end_ = result.end;
  for (Progress& progress : result.history) {
    if (!shown) break;
    progress.generation += generations_shown_;
    history_.push_back(std::move(progress));
  }
  facts_.workers = std::max(facts_.workers, result.workers);
  facts_.islands = std::max(facts_.islands, result.fronts.size());
  facts_.generations += result.generations;
  facts_.evaluations += result.evaluations;
  facts_.migrations += result.migrations;
  facts_.dropped_samples += result.dropped;
  for (const auto& [worker, share] : result.waited_share) facts_.waited_share[worker] = share;
  if (!shown) return;
  generations_shown_ += static_cast<std::uint32_t>(generations);
  fronts_ = std::move(result.fronts);
}

}  // namespace demecal
