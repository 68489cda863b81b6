// The closed loop alone: what a declared model lacks, without evolving anything.
#pragma once

#include <optional>

#include "closed_calibration/closing.hpp"
#include "coordinator/calibrate.hpp"

namespace demecal {

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

}  // namespace demecal
