// The report as tables for a terminal.
#pragma once

#include <string>

#include "report/calibration_report.hpp"

namespace demecal {

/// Mean, rms, P95 and max in mm of every stage on every set that has poses; the joints' errors in rad; what the poses
/// could not see; what was named. At most 100 columns wide.
std::string to_terminal(const CalibrationReport& report);

/// One stage's figures, as `evaluate` prints them.
std::string errors_to_terminal(const ErrorBySet& errors);

/// How far single poses are predicted to err, and how many accept poses did not keep to it; nothing without an
/// interval.
std::string intervals_to_terminal(const std::vector<PoseErrorLine>& poses,
                                  const std::optional<PredictionInterval>& interval);

}  // namespace demecal
