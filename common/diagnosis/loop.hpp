// The closed loop: residual, structure, effect, gain, again, until nothing is left or nothing is gained.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/detectable.hpp"
#include "diagnosis/outcome.hpp"
#include "effect_sets/set_island.hpp"
#include "explanations/explanation_front.hpp"
#include "explanations/explanation_search.hpp"
#include "explanations/set_models.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// Who does what others can do as well, to the bit: this process, or workers too.
struct LoopWork {
  SearchExplanations search_explanations = demecal::search_explanations;
  DoWork do_work = demecal::do_work;
};

struct LoopOptions {
  std::vector<std::string> kinds;  ///< words of the catalogue to consider; empty: all
  int max_effects = 150;
  double family_error = 0.05;  ///< chance of adding anything to a model that lacks nothing
  int null_draws = 999;
  int resamples = 400;
  int group_size = 24;                ///< effects that may be added between two joint refits
  double least_gain = 0.005;          ///< share of the validation error that a group must win for another to follow
  int highest_ratio = 200;            ///< of the scan over gear harmonics
  std::vector<double> stated_ratios;  ///< beyond the scan
  bool formulas = true;               ///< formulas outside the catalogue compete, where there are at most 5000 poses
  std::vector<Candidate> evolved{};   ///< formulas that evolution found on the residual: they compete too
  /// Best gains (nats, ascending) of the same evolution on permuted residuals: what `evolved` candidates are held
  /// against; empty: as all others are.
  std::vector<double> evolved_null_gains{};
  bool decoys = true;
  bool noise = true;  ///< how at most 400 fitted poses scatter together is estimated; others are independent
  /// For sets of effects, when nothing more can be added; without variations effects can only be left out.
  ExplanationSearch explanations{};
  LoopWork work{};
  std::uint64_t seed = 1;
};

/// Told of every round as it ends; returns false to stop the loop with what it has.
using RoundWatcher = std::function<bool(const Round&)>;

struct LoopResult {
  DiagnosedModel before;  ///< everything declared, at its least-squares values: the loop's start. With the
                          ///< noise estimated it would be weighted by what the model still lacks
  DiagnosedModel model;   ///< with the effects that were chosen
  std::optional<DiagnosedModel> best{};  ///< the model of the least error on the validation poses, where it is another
  ExplanationFront front{};              ///< about the model
  LoopOutcome outcome;
};

/// Runs the ten steps and the search for explanations from `start`, a declared model already fitted (its corrections
/// are kept and, where joint corrections are declared, smooth terms added to them). Calibration poses fit, validation
/// poses confirm (where there are none, resampling of the calibration poses alone does); accept poses are never looked
/// at. A function of its arguments.
LoopResult close_loop(const DataSet& data, const DeclaredModel& declared, const Fit& start, const LoopOptions& options,
                      const RoundWatcher& watch = {});

/// Drops effects one after another, the least needed first, as long as that shortens the description, and refines
/// the model after each. Dropped effects are noted in the outcome. Returns the surroundings of the model that is left.
Linearization eliminate_backward(const DiagnosisProblem& problem, DiagnosedModel& model,
                                 const std::vector<Candidate>& candidates, LoopOutcome& outcome);

/// Whether the model leaves clearly more of the fitted poses' errors than another: robust weights can make of most
/// poses gross errors, where there are few.
bool leaves_more(const DiagnosisProblem& problem, const DiagnosedModel& model, const DiagnosedModel& than);

/// The sum of squares (m^2) of what the model leaves of the fitted poses' positions, and the freedom they have left.
struct PositionSums {
  double squares = 0.0, freedom = 0.0;
};
PositionSums position_errors(const DiagnosisProblem& problem, const Linearization& linearization,
                             const RowScales& scales);

/// The model with its noise as the fitted poses say, at its least-squares values by that; twice at `first`, since
/// either depends on the other. The model itself of more than 400 poses, whose many small errors that no model has
/// would be taken for noise, and of contacts.
DiagnosedModel with_noise_known(const DiagnosisProblem& problem, DiagnosedModel model, bool first);

/// Sets what repeats tell of the model: their scatter, whether it lacks anything, and how much of the mean square
/// beyond that scatter it explains, the first time none. `start_excess_m2` is that of the first time.
void measure_lack_of_fit(const DiagnosisProblem& problem, const DiagnosedModel& model,
                         const Linearization& linearization, std::optional<double>& start_excess_m2,
                         LoopOutcome& outcome);

/// Brings the rounds up to date with the final model: added effects with their values in it; those that are no longer
/// in it were not added after all.
void update_rounds(LoopOutcome& outcome, const CorrectedRobot& model, const Robot& described);

/// Rivals of the effects that were added, beside all others of the final model: those found when an effect was added
/// are of a model that lacked others.
void update_rivals(const FinishedLoop& loop, std::vector<Round>& rounds);

/// What to measure next, for the first few effects that have rivals.
void find_next_measurements(const DiagnosisProblem& problem, const DiagnosedModel& model, const RandomStream& random,
                            std::vector<Round>& rounds);

/// The poses of the last fit: calibration and validation poses where there are accept poses to tell the error by,
/// calibration poses alone where there are none.
std::vector<std::size_t> poses_of_last_fit(const DataSet& data);

/// The same model, its effects as they were chosen, with its numbers at their least-squares values over
/// poses_of_last_fit(data), and its effects and smooth terms known over these poses' range. What the poses then say of
/// it is no longer unseen, but for the accept poses.
DiagnosedModel final_fit(const DataSet& data, const DeclaredModel& declared, DiagnosedModel model);

}  // namespace demecal::inline diagnosis
