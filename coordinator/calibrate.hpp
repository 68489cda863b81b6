// The main job: from a job file to a model, a report and a history in a folder.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "calibration/job.hpp"
#include "coordinator/chronicle.hpp"
#include "coordinator/evolution_run.hpp"
#include "coordinator/exit_codes.hpp"
#include "coordinator/run_journal.hpp"
#include "data/data_set.hpp"
#include "distal/steps.hpp"
#include "report/make_report.hpp"
#include "structure/structure_fit.hpp"

namespace demecal {

/// How a calibration reaches its workers: opens the transport, and keeps the workers that it starts alive from one run
/// to the next.
class Fleet {
 public:
  virtual ~Fleet() = default;
  virtual Transport& transport() = 0;
  /// Called before each run: starts workers where none that it started is left. `run`: one of this coordinator's.
  virtual void launch(RunId run) = 0;
};

struct CalibrateOptions {
  RunPatience patience;
  bool quiet = false;
  bool asynchronous = false;       ///< islands wait for no neighbour: the result depends on timing
  Chronicle* chronicle = nullptr;  ///< told what happens, for people; none: nobody
  RunJournal* journal = nullptr;   ///< where evolutions are recorded and taken up again; none: nowhere
};

struct CalibrateResult {
  RunEnd end = RunEnd::finished;
  CalibratedModel model;
  Preparation preparation;
  Calibration calibration;
  CorrectedRobot before;  ///< what the closed loop started from
  LoopOutcome loop;
  std::vector<Progress> history;
  std::vector<DistalStep> distal;          ///< of distal learning, before the loop
  KnownFunctions functions;                ///< that joints share; nothing where the job does not ask for any
  std::vector<FoundTransform> structure;   ///< of the structural method
  std::map<IslandKey, Population> fronts;  ///< that islands ended with before the loop: best of each length
  RunFacts facts;
  DataCheck check;  ///< of the data, before anything was fitted
};

/// The model of a calibration, and where it came from.
CalibratedModel model_of(const DataSet& data, const Job& job, const Calibration& calibration);

/// Everything but files: prepares, evolves on the fleet, concludes, and closes the loop unless the job allows it no
/// effects. One fleet is asked for where joint corrections are evolved, and serves all evolutions; another takes its
/// place after one that was stuck. The structural method evolves no corrections: it needs no fleet, and no loop
/// follows. Throws InputError for data that the job cannot be fitted to.
CalibrateResult calibrate(const DataSet& data, const Job& job,
                          const std::function<std::unique_ptr<Fleet>()>& make_fleet, const std::atomic<bool>& interrupt,
                          const CalibrateOptions& options);

}  // namespace demecal
