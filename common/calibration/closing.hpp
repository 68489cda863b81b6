// The closed loop around a calibration: what it starts from, and what the model it leaves means for the joints.
#pragma once

#include "calibration/calibration.hpp"
#include "diagnosis/loop.hpp"

namespace demecal {

/// How the job wants the loop run on a model that holds `held` effects already.
LoopOptions loop_options(const Job& job, std::size_t held = 0);

/// Where the loop starts: `robot`, its residuals scattering as they do over the calibration poses. Kinds of rows that
/// the fit of the declared model did not use are not used.
Fit loop_start(const DataSet& data, const Fit& declared, const CorrectedRobot& robot);

/// The robot whose corrections the loop is best started from: `robot`, or the same without any, whichever does better
/// on the deciding poses once smooth terms are fitted beside them. Where joint corrections are not declared, `robot`.
CorrectedRobot best_started(const DataSet& data, const DeclaredModel& declared, const Fit& fit,
                            const CorrectedRobot& robot);

/// Leaves terms out of a model's corrections that move nothing by a hundredth of a micrometre.
void tidy(DiagnosedModel& model);

/// A calibration whose robot is a model of the loop: its numbers with standard errors, and what is left of the joints'
/// errors with the corrections in place.
Calibration calibration_of(const DataSet& data, const DeclaredModel& declared, const Preparation& preparation,
                           const DiagnosedModel& model);

/// What stands before corrections are evolved anew: the declared model is `model` without its corrections, and the
/// joints learn what its effects leave.
Preparation prepare_again(const DataSet& data, const Preparation& first, const CorrectedRobot& model);

/// Makes a later calibration tell its figures "before" as the first one does.
void count_from(const Calibration& first, Calibration& calibration);

}  // namespace demecal
