// The main jobs, everything but files and terminals: calibration, diagnosis and study, from measured poses and a job to
// a model and what is to be said of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closing.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "diagnosis/outcome.hpp"
#include "distal/steps.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/building_blocks.hpp"
#include "evolution/population.hpp"
#include "explanations/explanation_search.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "protocol/messages.hpp"
#include "report/make_report.hpp"
#include "residuals/diagnosed_model.hpp"
#include "scheduling/evolution_run.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/run_journal.hpp"
#include "scheduling/run_state.hpp"
#include "scheduling/worker_pool.hpp"
#include "structure/structure_fit.hpp"
#include "studies/study.hpp"
#include "trials/finding.hpp"
#include "updating/fleet_model.hpp"

namespace demecal::inline workflows {
/// Told what happens in a calibration, as it happens. The result does not depend on it.
class CalibrationObserver : public EvolutionObserver {
 public:
  /// What is learnt begins: joint corrections in stages, or the closed loop.
  virtual void on_learning_begins(const Robot& /*described*/) {}
  virtual void on_round(const Round& /*round*/, const Robot& /*described*/) {}
  /// A sentence for people on what is being done.
  virtual void on_message(const std::string& /*text*/) {}
  /// A generation of the structural search is over; the best structure leaves `left` of the validation poses' squares.
  virtual void on_structure_generation(int /*generation*/, int /*generations*/, double /*left*/) {}
};

struct CalibrateOptions {
  RunPatience patience;
  bool asynchronous = false;                  ///< islands wait for no neighbour: the result depends on timing
  CalibrationObserver* observer = nullptr;    ///< none: nobody
  RunJournal* journal = nullptr;              ///< where evolutions are recorded and taken up again; none: nowhere
  std::optional<double> share_work_from_s{};  ///< as of EvolverOptions
};

struct CalibrateResult {
  RunEnd end = RunEnd::finished;
  CalibratedModel model;
  std::optional<CalibratedModel> best{};  ///< of the least error on the validation poses, where it has more causes
  Preparation preparation;
  Calibration calibration;
  CorrectedRobot before;  ///< what the closed loop started from
  LoopOutcome loop;
  std::vector<Progress> history;
  std::vector<DistalStep> distal;           ///< of distal learning, before the loop
  KnownFunctions functions;                 ///< that joints share; nothing where the job does not ask for any
  std::vector<FoundTransform> structure;    ///< of the structural method
  std::vector<JointCandidates> candidates;  ///< that corrections were chosen from, before the loop
  std::map<IslandKey, Population> fronts;   ///< that islands ended with before the loop: best of each length
  RunFacts facts;
  DataCheck check;                   ///< of the data, before anything was fitted
  std::vector<std::string> remarks;  ///< sentences on how the result came about
};

/// The model of a calibration, and where it came from.
CalibratedModel make_model(const DataSet& data, const Job& job, const Calibration& calibration);

/// Prepares, evolves on the pool, concludes, and closes the loop unless the job allows it no effects. One pool of
/// workers is asked for where joint corrections or explanations are evolved, and serves all evolutions; another takes
/// its place after one that was stuck. The structural method evolves neither: it needs no pool, and no loop follows.
/// The method diagnose is diagnose() with what the job declares, its explanations evolved on the pool. Throws
/// InputError for data that the job cannot be fitted to.
CalibrateResult calibrate(const DataSet& data, const Job& job, const MakeWorkerPool& make_pool,
                          const std::atomic<bool>& interrupt, const CalibrateOptions& options);

/// By transforms between the links: searched for in this process, without workers. Base, tool, offsets and geometry as
/// the job declares them are fitted for comparison; the search starts from base and tool alone. Interrupted, it keeps
/// the best structure so far.
CalibrateResult calibrate_structurally(const DataSet& data, const Job& job, const std::atomic<bool>& interrupt,
                                       const CalibrateOptions& options);

struct StudyOutcome {
  RunEnd end = RunEnd::finished;
  std::vector<StudyRun> runs;       ///< those that came to their end
  std::vector<IslandFront> fronts;  ///< of the runs' islands
};

/// The figures of a calibration that came to its end; cell and seed are left to the caller. Where validation poses had
/// a part in the last fit, what they said before.
StudyRun figures_of(const DataSet& data, const CalibrateResult& result);

/// Runs every job with every seed: all jobs with the first seed, then all with the second, so that what an interruption
/// leaves compares them alike. `on_run` is told of each run that came to its end, after it was added. Ends with the
/// first that does not. Throws InputError for data that a job cannot be fitted to.
StudyOutcome run_study(const DataSet& data, std::span<const Job> jobs, std::span<const std::uint64_t> seeds,
                       const MakeWorkerPool& make_pool, const std::atomic<bool>& interrupt,
                       const CalibrateOptions& options, const std::function<void(const StudyOutcome&)>& on_run);

/// What is declared where the user says nothing: registration, tool, joint offsets and geometry, where there are more
/// measured numbers than parameters (of links more is known: what makers state; of data with contacts twice as many),
/// or as much of it as leaves twice as many.
DeclaredModel declared_by_default(const DataSet& data);

struct Diagnosis {
  CalibrateResult result;  ///< as of a calibration
  DiagnosedModel model;    ///< the same model, as the loop left it
};

/// Runs the loop on `known`, a model found before, its numbers fitted again; without it on the job's declared model.
/// Ends early when `watch` returns false. `work`: who evolves explanations and does what is done in pieces, this
/// process unless told otherwise. Throws InputError for data that the model cannot be fitted to.
Diagnosis diagnose(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known,
                   const RoundWatcher& watch, const LoopWork& work = {});

/// Brings `prior`, a model found before, up to date: see updated(); `earlier` models of the robot, if any, tell how far
/// it drifts (learned_drift()). Of many poses the loop's own model is kept where it
/// leaves less of unseen validation poses; it ends early when `watch` returns false. Throws InputError for data that
/// base and tool cannot be fitted to.
CalibrateResult update_model(const DataSet& data, const Job& job, const NamedModel& prior, const RoundWatcher& watch,
                             const std::vector<NamedModel>& earlier = {});

/// Throws InputError where the model has another number of joints than the data set's arm, or no tool for a target.
void require_same_arm(const CorrectedRobot& robot, const DataSet& data);

/// Throws InputError where the data set's arm, as described, stands elsewhere at its poses than the one that the model
/// corrects: 2 cm or more at its flange.
void require_alike_arm(const CalibratedModel& model, const DataSet& data);

/// Throws InputError where the data set's robot states a tool point that is neither the one that the model's robot
/// states nor the one that was identified, each within 3 mm: the model would be blamed for another tool.
void require_alike_tool(const CalibratedModel& model, const DataSet& data);

/// As require_same_arm(), and where its maker's figures are not those that the model was made from.
void require_same_nominal_arm(const CalibratedModel& model, const DataSet& data);

}  // namespace demecal::inline workflows
