// The folder a calibration leaves: model.yaml, report.json, report.html and, where formulas were evolved, history.csv.
#pragma once

#include <string>

#include "coordinator/calibrate.hpp"

namespace demecal {

/// Makes the folder where it is missing. Throws InputError where it cannot be written to; called before long work, so
/// that none is lost.
void make_writable(const std::string& folder);

/// Writes the model, reads it back, and writes the report of what was read, so that evaluating model.yaml gives the
/// same figures to the last digit. Each file appears whole or not at all.
CalibrationReport write_results(const std::string& folder, const DataSet& data, const CalibrateResult& result);

}  // namespace demecal
