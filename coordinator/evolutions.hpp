// The evolutions of one calibration: the first, and those that follow when effects were found.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibration/evolver.hpp"
#include "coordinator/calibrate.hpp"

namespace demecal {

/// The evolutions of one calibration, each a run of its own. One fleet serves them all: its workers know each other,
/// and begin with the next run at once. One that the journal tells the end of is not run again; one that it tells the
/// beginning of goes on from there. A run that is stuck is begun anew, on another fleet.
class Evolutions final : public Evolver {
 public:
  Evolutions(const Job& job, const std::function<std::unique_ptr<Fleet>()>& make_fleet,
             const std::atomic<bool>& interrupt, const CalibrateOptions& options)
      : job_(job), make_fleet_(make_fleet), interrupt_(interrupt), options_(options) {}

  /// The candidates that the islands found, or had reached when the run ended; `end` says how it did. All but searches
  /// for the null distribution are shown to people, in a display and the history.
  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override;
  bool is_interrupted() const override { return interrupt_; }
  void add_effort(std::uint32_t generations, std::uint64_t evaluations) override;
  /// Has the fleet's workers start before anything is to be evolved: they take their time to come.
  void gather();
  /// Lets the fleet go. It serves no more: another would be made.
  void dismiss();
  RunEnd end() const { return end_; }
  /// Rows of all runs; the generations of a later one follow those of the earlier.
  std::vector<Progress> take_history() { return std::move(history_); }
  /// What the islands of the last run that was shown ended with.
  std::map<IslandKey, Population> take_fronts() { return std::move(fronts_); }
  const RunFacts& facts() const { return facts_; }

 private:
  RunState start_of(const CalibrationData& data);
  RunResult run(RunState state, bool shown);
  RunResult attempt(RunState& state, bool shown);
  void note(RunResult& result, int generations, bool shown);
  void let_go();

  const Job& job_;
  const std::function<std::unique_ptr<Fleet>()>& make_fleet_;
  const std::atomic<bool>& interrupt_;
  const CalibrateOptions& options_;
  std::unique_ptr<Fleet> fleet_;                 ///< from the first run on
  std::map<std::string, WorkerStatus> present_;  ///< its workers when the last run ended
  std::uint64_t dropped_ = 0;                    ///< by its transport, as counted so far
  RunEnd end_ = RunEnd::finished;
  std::vector<Progress> history_;
  std::map<IslandKey, Population> fronts_;
  RunFacts facts_;
  std::uint32_t generations_shown_ = 0;  ///< that islands of runs shown so far bred, each
};

}  // namespace demecal
