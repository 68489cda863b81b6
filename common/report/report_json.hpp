// The report as JSON, with the keys other programs rely on.
#pragma once

#include <string>

#include "report/calibration_report.hpp"
#include "report/unapplied_effects.hpp"

namespace demecal {

/// Indented JSON with `demecal_report: 1`; figures that do not exist are null.
std::string to_json(const CalibrationReport& report);

/// {"error_mm": {"calibration": {mean, rms, p95, max}, "validation": ..., "accept": ...}, "pose_errors": [...],
/// "data_check": ...} on one line; pose_errors as in the report, before_mm null.
std::string errors_to_json(const ErrorBySet& errors, const DataCheck& check = {},
                           const std::vector<UnappliedEffect>& unapplied = {},
                           const std::vector<PoseErrorLine>& poses = {});

}  // namespace demecal
