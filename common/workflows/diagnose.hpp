// The closed loop alone: what a declared model lacks, without evolving anything; and which models suit which data.
#pragma once

#include <optional>

#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/closing.hpp"
#include "workflows/calibrate.hpp"

namespace demecal::inline workflows {

/// What is declared where the user says nothing: registration, tool, joint offsets and geometry, or as much of it as
/// leaves twice as many measured numbers as parameters.
DeclaredModel declared_by_default(const DataSet& data);

struct Diagnosis {
  CalibrateResult result;  ///< as of a calibration
  DiagnosedModel model;    ///< the same model, as the loop left it
};

/// Runs the loop on `known`, a model found before, its numbers fitted again; without it on the job's declared model.
/// Ends early when `watch` returns false. Throws InputError for data that the model cannot be fitted to.
Diagnosis diagnose(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known,
                   const RoundWatcher& watch);

/// Throws InputError where the model has another number of joints than the data set's arm, or no tool for a target.
void require_same_arm(const CalibratedModel& model, const DataSet& data);

/// The same, and where its maker's figures are not those that the model was made from.
void require_same_nominal_arm(const CalibratedModel& model, const DataSet& data);

}  // namespace demecal::inline workflows
