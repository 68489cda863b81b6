// The closed loop alone: what a declared model lacks, without evolving anything.
#pragma once

#include <optional>

#include "calibration/closing.hpp"
#include "coordinator/calibrate.hpp"

namespace demecal {

/// What is declared where the user says nothing: registration, tool, joint offsets and geometry, or as much of it as
/// leaves twice as many measured numbers as parameters.
DeclaredModel declared_by_default(const DataSet& data);

/// What a diagnosis starts from: `known`, a model found before, its numbers fitted again; without it the job's declared
/// model. Throws InputError for data that it cannot be fitted to.
Preparation diagnosis_start(const DataSet& data, const Job& job, const std::optional<CalibratedModel>& known);

/// Runs the loop on `start`; data set, job and result as those of a calibration. Ends early when `watch` returns false.
CalibrateResult diagnose(const DataSet& data, const Job& job, Preparation start, const RoundWatcher& watch);

}  // namespace demecal
