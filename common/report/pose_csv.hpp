// Every pose of a report as a row of a table.
#pragma once

#include <string>

#include "report/report.hpp"

namespace demecal::inline report {

/// pose-errors.csv: id, target, set, errors, radius, flags, joints, measured position, error by axis before and after,
/// temperature and time; what no pose has is left out, what one pose lacks is empty.
std::string pose_errors_csv(const Report& report);

}  // namespace demecal::inline report
