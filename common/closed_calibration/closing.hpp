// The closed loop around a calibration: what it starts from, what the model it leaves means for the joints, and the
// last fit, when all choices are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "explanations/error_budget.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline closed_calibration {

/// How the job wants the loop run on a model that holds `held` effects already.
LoopOptions loop_options(const Job& job, std::size_t held = 0);

/// The robot whose corrections the loop is best started from: `robot`, or the same without any, whichever does better
/// on the selection poses once smooth terms are fitted beside them. Where joint corrections are not declared, `robot`.
CorrectedRobot better_start(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                            const CorrectedRobot& robot);

/// Leaves terms out of a model's corrections that move nothing by a hundredth of a micrometre.
void drop_negligible_terms(DiagnosedModel& model);

/// The model with the smooth terms of a joint believed to be smaller for as long as its correction may exceed
/// correction_limit_rad(): where few poses stand, sums of smooth terms go astray. Fitted to `poses`; negligible terms
/// dropped.
DiagnosedModel with_bounded_corrections(const DataSet& data, const DeclaredModel& declared,
                                        const Preparation& preparation, const std::vector<std::size_t>& poses,
                                        DiagnosedModel model);

/// A calibration whose robot is a model of the loop: its numbers with standard errors, and what is left of the joints'
/// errors with the corrections in place. Where these are from is said of those that the loop has made.
Calibration calibration_of(const DataSet& data, const DeclaredModel& declared, const Preparation& preparation,
                           const DiagnosedModel& model);

/// Sets where the corrections of `calibration`, which calibration_of() made of `model`, are from, when `start` are the
/// summaries of the corrections that the loop began with.
void set_origins(const DiagnosedModel& model, const std::vector<JointSummary>& start, Calibration& calibration);

/// The same of the model of the least error, where it is not the chosen one, after the last fit; `before` is the robot
/// that the loop started from.
std::optional<Calibration> calibration_of_best(const DataSet& data, const DeclaredModel& declared,
                                               const Preparation& preparation, const CorrectedRobot& before,
                                               std::optional<DiagnosedModel> best);

/// What stands before corrections are evolved anew: the declared model is `model` without its corrections, and the
/// joints learn what its effects leave.
Preparation prepare_beside_effects(const DataSet& data, const Preparation& first, const CorrectedRobot& model);

/// Copies the figures "before" of the first calibration to a later one.
void keep_first_figures(const Calibration& first, Calibration& calibration);

/// `robot` as a model whose corrections a fit leaves as they are.
DiagnosedModel with_fixed_corrections(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                                      const CorrectedRobot& robot);

/// What the closed loop started from, and what it ended with.
struct LoopModels {
  DiagnosedModel before, after;
};

struct LastFit {
  LoopModels ends;          ///< fitted once more as final_fit() says; `after` with bounded corrections
  UnseenValidation unseen;  ///< of the ends before that
};

/// The causes behind the effects of `model`, which the calibration poses made; `front` is about them; `last` is the
/// same after the last fit.
ErrorBudget error_budget_of(const DataSet& data, const DeclaredModel& declared, const DiagnosedModel& model,
                            const ExplanationFront& front, const DiagnosedModel& last, std::uint64_t seed);

/// Nothing where it would change neither end.
std::optional<LastFit> last_fit(const DataSet& data, const DeclaredModel& declared, const Preparation& preparation,
                                LoopModels ends);

}  // namespace demecal::inline closed_calibration
