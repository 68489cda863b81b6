// Evolution on islands: the Evolver that schedules them over a pool of workers, run by run.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/training.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effect_sets/set_island.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/population.hpp"
#include "explanations/explanation_search.hpp"
#include "protocol/messages.hpp"
#include "report/make_report.hpp"
#include "scheduling/evolution_run.hpp"
#include "scheduling/run_journal.hpp"
#include "scheduling/run_state.hpp"
#include "scheduling/worker_pool.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline scheduling {

/// Told what happens in the runs of an evolver, as it happens.
class EvolutionObserver : public RunObserver {
 public:
  /// `reached`: figures of islands of a run that goes on from where it was broken off; no worker will give them again.
  /// `shown`: whether the run is for people to see.
  virtual void on_run_begins(const CalibrationData& /*data*/, const std::vector<Progress>& /*reached*/,
                             bool /*shown*/) {}
  virtual void on_run_ends(RunEnd /*end*/) {}
  /// The workers that serve this coordinator alone are let go.
  virtual void on_workers_end() {}
};

struct EvolverOptions {
  RunPatience patience;
  bool asynchronous = false;              ///< islands wait for no neighbour: the result depends on timing
  EvolutionObserver* observer = nullptr;  ///< none: nobody
  RunJournal* journal = nullptr;          ///< where runs are recorded and taken up again; none: nowhere
  /// Workers take part in the closed loop's scans, draws and resamplings that would take one thread so long; none: in
  /// none of them.
  std::optional<double> share_work_from_s{};
};

/// The evolutions of one calibration: the first, and those that follow when effects were found; each a run of its own.
/// One pool of workers serves them all: its workers know each other, and begin with the next run at once. A run that
/// the journal tells the end of is not run again; one that it tells the beginning of goes on from there. Searches for
/// explanations are runs, too, which no journal knows. A run that is
/// stuck is begun anew, on another pool.
class IslandEvolver final : public Evolver {
 public:
  IslandEvolver(const Job& job, MakeWorkerPool make_pool, const std::atomic<bool>& interrupt,
                const EvolverOptions& options)
      : job_(job), make_pool_(std::move(make_pool)), interrupt_(interrupt), options_(options) {}

  /// The candidates that the islands found, or had reached when the run ended; `end` says how it did. All but searches
  /// for the null distribution are for people to see, and in the history.
  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override;
  /// By the pool's workers; here where none can be started or comes, or where the matrices do not fit into a message.
  /// Not journalled: it takes seconds, and what it finds is a function of its arguments.
  std::vector<EffectSet> search_explanations(const ExplanationProblem& problem, const SetSearch& search) override;
  /// By this process and the pool's workers at once, where work is shared and workers would take it: a worker that is
  /// lost is not missed. These runs are neither told to the observer nor journalled.
  std::vector<std::vector<double>> do_work(const SharedWork& work) override;
  /// Why the last search for explanations was made in this process; empty where workers made it.
  const std::string& searched_here_because() const { return searched_here_because_; }
  bool is_interrupted() const override { return interrupt_; }
  void add_effort(std::uint32_t generations, std::uint64_t evaluations) override;

  /// Has the pool's workers start before anything is to be evolved: they take their time to come.
  void start_workers();
  /// Lets the pool go. It serves no more: another would be made.
  void dismiss_workers();
  RunEnd end() const { return end_; }
  /// Of work that was shared: pieces in all, and those that workers were first to do.
  struct ShareOfWorkers {
    std::size_t pieces = 0, elsewhere = 0;
  };
  const ShareOfWorkers& share_of_workers() const { return share_of_workers_; }
  /// Rows of all runs; the generations of a later one follow those of the earlier.
  std::vector<Progress> take_history() { return std::move(history_); }
  /// What the islands of the last run that was shown ended with.
  std::map<IslandKey, Population> take_fronts() { return std::move(fronts_); }
  const RunFacts& facts() const { return facts_; }

 private:
  RunState known_state(const CalibrationData& data);
  RunResult run(RunState state, bool shown, RunJournal* journal);
  RunResult attempt(RunState& state, bool shown, RunJournal* journal);
  void count(RunResult& result, int generations, bool shown);
  void count_workers(const RunResult& result);
  void end_shared_run();
  bool can_start_workers();
  RunPatience patience_for(const CalibrationData& data) const;
  void release_workers();

  const Job& job_;
  MakeWorkerPool make_pool_;
  const std::atomic<bool>& interrupt_;
  EvolverOptions options_;
  std::unique_ptr<WorkerPool> pool_;             ///< from the first run on
  std::map<std::string, WorkerStatus> present_;  ///< its workers when the last run ended
  std::uint64_t rejected_ = 0;                   ///< by its transport, as counted so far
  RunEnd end_ = RunEnd::finished;
  std::vector<Progress> history_;
  std::map<IslandKey, Population> fronts_;
  RunFacts facts_;
  bool no_worker_came_ = false;  ///< to a search for explanations: no further one waits for any
  std::string searched_here_because_;
  ShareOfWorkers share_of_workers_;
  bool no_worker_shared_ = false;  ///< the last work: further work is done here
  std::atomic<bool> shared_run_over_{false};
  std::future<RunResult> shared_run_;    ///< of work; it ends while the loop goes on
  std::uint32_t generations_shown_ = 0;  ///< that islands of runs shown so far bred, each
};

}  // namespace demecal::inline scheduling
