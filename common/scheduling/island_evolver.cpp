#include "scheduling/island_evolver.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <ratio>
#include <stdexcept>
#include <utility>

#include "calibration/selection.hpp"
#include "effect_sets/set_training.hpp"
#include "errors/input_error.hpp"
#include "expression/shared_function.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/faults.hpp"
#include "scheduling/shared_pieces.hpp"
#include "transport/transport.hpp"

namespace demecal::inline scheduling {
namespace {

constexpr std::chrono::milliseconds kDismissTimeout{2000};

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

/// Why workers would refuse data that have no run's number yet.
Fault fault_without_run(CalibrationData& data) {
  data.run = 1;
  Fault fault = find_fault(data);
  data.run = 0;
  return fault;
}

/// Data that workers would refuse are the user's error.
CalibrationData believable(CalibrationData data) {
  if (const Fault fault = fault_without_run(data)) {
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

/// How long a worker of one slot may take for an epoch of all islands: it makes well over twenty sets a second.
std::chrono::milliseconds longest_epoch(const SetTraining& sets) {
  constexpr std::chrono::milliseconds kSet{50};
  return kSet * sets.variations / static_cast<int>(kSetEpochs);
}

/// However the work ends, its run does too.
struct EndsSharedRun {
  std::atomic<bool>& over;
  ~EndsSharedRun() { over = true; }
};

/// Has an observer and a journal follow what happens, as far as they are there.
class RecordedRun final : public RunObserver {
 public:
  RecordedRun(RunObserver* observer, RunJournal* journal) : observer_(observer), journal_(journal) {}
  void on_progress(const Progress& progress) override { notify(&RunObserver::on_progress, progress); }
  void on_checkpoint(const Checkpoint& checkpoint) override { notify(&RunObserver::on_checkpoint, checkpoint); }
  void on_outcome(const Outcome& outcome) override { notify(&RunObserver::on_outcome, outcome); }
  void on_worker(const WorkerStatus& status) override { notify(&RunObserver::on_worker, status); }
  void on_lost(const std::string& worker) override { notify(&RunObserver::on_lost, worker); }
  void on_tick() override {
    if (observer_ != nullptr) observer_->on_tick();
    if (journal_ != nullptr) journal_->on_tick();
  }

 private:
  template <class Event>
  void notify(void (RunObserver::*on_event)(const Event&), const Event& event) {
    if (observer_ != nullptr) (observer_->*on_event)(event);
    if (journal_ != nullptr) (static_cast<RunObserver*>(journal_)->*on_event)(event);
  }

  RunObserver* observer_;
  RunJournal* journal_;
};

}  // namespace

EvolvedJoints IslandEvolver::evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) {
  if (trainings.empty()) return {{}, end_ == RunEnd::finished};
  const bool shown = terms.purpose != Purpose::null_distribution;
  RunState state = known_state(believable(calibration_data(job_, trainings, terms, options_.asynchronous)));
  RunResult result =
      state.all_finished() ? state.result(RunEnd::finished) : run(std::move(state), shown, options_.journal);
  EvolvedJoints evolved{candidates_of(trainings, result), result.end == RunEnd::finished};
  count(result, terms.generations, shown);
  return evolved;
}

std::vector<EffectSet> IslandEvolver::search_explanations(const ExplanationProblem& problem, const SetSearch& search) {
  if (interrupt_) return {};
  CalibrationData data = data_of_search(problem, search);
  data.job = job_.name;
  data.seed = job_.seed;
  const Fault fault = fault_without_run(data);
  searched_here_because_ = fault                  ? "workers would refuse them: " + *fault
                           : no_worker_came_      ? "no worker came"
                           : !can_start_workers() ? "no worker can be started"
                                                  : "";
  if (!searched_here_because_.empty()) return Evolver::search_explanations(problem, search);
  const RunResult result = run(RunState(std::move(data)), true, nullptr);
  facts_.evolved_sets += result.evaluations;
  count_workers(result);
  if (result.end == RunEnd::no_worker) {
    no_worker_came_ = true;
    searched_here_because_ = "no worker came";
    return Evolver::search_explanations(problem, search);
  }
  std::vector<Population> fronts;
  for (const auto& [island, front] : result.fronts) fronts.push_back(front);
  return front_of(problem, fronts);
}

std::vector<std::vector<double>> IslandEvolver::do_work(const SharedWork& work) {
  end_shared_run();
  if (!options_.share_work_from_s || no_worker_shared_ || interrupt_ || work.pieces() == 0)
    return Evolver::do_work(work);
  const auto pieces = std::make_shared<SharedPieces>(work.pieces());
  if (pieces->do_last(work) < *options_.share_work_from_s) return pieces->do_rest(work);
  CalibrationData data = data_of_work(work);
  data.job = job_.name;
  data.seed = job_.seed;
  if (fault_without_run(data) || !can_start_workers()) return pieces->do_rest(work);
  data.run = pool_->transport().new_run();
  pool_->launch(data.run);
  shared_run_over_ = false;
  shared_run_ = std::async(std::launch::async, [this, pieces, state = RunState(std::move(data))]() mutable {
    return EvolutionRun(pool_->transport(), std::move(state), *pieces, present_)
        .run(shared_run_over_, options_.patience);
  });
  const EndsSharedRun ends{shared_run_over_};
  std::vector<std::vector<double>> done = pieces->do_rest(work);
  share_of_workers_.pieces += done.size();
  share_of_workers_.elsewhere += pieces->done_elsewhere();
  return done;
}

/// Before anything else is asked of the transport. What went wrong there is the next run's to meet: the work is done.
void IslandEvolver::end_shared_run() {
  if (!shared_run_.valid()) return;
  try {
    RunResult result = shared_run_.get();
    present_ = std::move(result.present);
    result.rejected -= std::exchange(rejected_, result.rejected);
    no_worker_shared_ = result.end == RunEnd::no_worker;
    count_workers(result);
  } catch (const std::runtime_error&) {
    no_worker_shared_ = true;
  }
}

RunState IslandEvolver::known_state(const CalibrationData& data) {
  auto recorded = options_.journal == nullptr ? std::nullopt : options_.journal->recorded(data);
  if (recorded) facts_.resumed = true;
  return recorded ? std::move(*recorded) : RunState(data);
}

/// Goes on from the state as a new run: workers may still be at the one that it comes from, which is over.
RunResult IslandEvolver::run(RunState state, bool shown, RunJournal* journal) {
  while (true) {
    RunResult result = attempt(state, shown, journal);
    if (result.end != RunEnd::stuck) return result;
    state = RunState(state.data());
    if (journal != nullptr) journal->forget();
  }
}

/// Under a number that shows whose the run is.
RunResult IslandEvolver::attempt(RunState& state, bool shown, RunJournal* journal) {
  end_shared_run();
  if (!pool_) pool_ = make_pool_();
  Transport& transport = pool_->transport();
  state.rename(transport.new_run());
  if (journal != nullptr) journal->begin(state.data());
  if (options_.journal != nullptr) {
    for (const RunId left : options_.journal->take_left())
      transport.publish(Control{left, Control::State::cancelled, state.data().job});
  }
  if (options_.observer != nullptr) options_.observer->on_run_begins(state.data(), state.progress(), shown);
  pool_->launch(state.data().run);
  RecordedRun recorded(options_.observer, journal);
  RunResult result = EvolutionRun(transport, state, recorded, present_).run(interrupt_, patience_for(state.data()));
  present_ = std::move(result.present);
  result.rejected -= std::exchange(rejected_, result.rejected);
  if (journal != nullptr) journal->finish();
  if (options_.observer != nullptr) options_.observer->on_run_ends(result.end);
  if (result.end != RunEnd::finished) release_workers();
  return result;
}

RunPatience IslandEvolver::patience_for(const CalibrationData& data) const {
  RunPatience patience = options_.patience;
  if (data.breeds == Breeds::sets) patience.idle += longest_epoch(data.sets);
  return patience;
}

void IslandEvolver::start_workers() {
  if (pool_) return;
  pool_ = make_pool_();
  pool_->launch(pool_->transport().new_run());
}

bool IslandEvolver::can_start_workers() {
  try {
    start_workers();
    return true;
  } catch (const std::runtime_error&) {
    pool_.reset();
    return false;
  }
}

void IslandEvolver::dismiss_workers() {
  end_shared_run();
  // Those who served it must learn that the last run is over.
  if (pool_ && !interrupt_) pool_->transport().flush(kDismissTimeout);
  release_workers();
}

void IslandEvolver::release_workers() {
  end_shared_run();
  if (!pool_) return;
  pool_.reset();
  present_.clear();
  rejected_ = 0;
  if (options_.observer != nullptr) options_.observer->on_workers_end();
}

void IslandEvolver::add_effort(std::uint32_t generations, std::uint64_t evaluations) {
  end_ = interrupt_ ? RunEnd::interrupted : RunEnd::finished;
  facts_.generations += generations;
  facts_.evaluations += evaluations;
}

void IslandEvolver::count_workers(const RunResult& result) {
  facts_.workers = std::max(facts_.workers, result.workers);
  facts_.dropped_samples += result.rejected;
  for (const auto& [worker, share] : result.waited_share) facts_.waited_share[worker] = share;
}

void IslandEvolver::count(RunResult& result, int generations, bool shown) {
  end_ = result.end;
  for (Progress& progress : result.history) {
    if (!shown) break;
    progress.generation += generations_shown_;
    history_.push_back(std::move(progress));
  }
  facts_.islands = std::max(facts_.islands, result.fronts.size());
  facts_.generations += result.generations;
  facts_.evaluations += result.evaluations;
  facts_.migrations += result.migrations;
  count_workers(result);
  if (!shown) return;
  generations_shown_ += static_cast<std::uint32_t>(generations);
  fronts_ = std::move(result.fronts);
}

}  // namespace demecal::inline scheduling
