// What a finished model is surely known by: its numbers' covariance, and how far its joints were moved to find it.
#pragma once

#include "calibration/calibrated_model.hpp"
#include "calibration/calibration.hpp"

namespace demecal {

/// The covariance of the model's numbers over the poses it was fitted to: of links, tools and effects, with the base
/// free beside them, and of what smooth terms could still change in corrections that are declared. Along what the poses
/// do not show it is as wide as makers' figures are uncertain (FitOptions), 10 mm and 0.1 rad for tools.
Posterior posterior_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration);

/// The lowest and highest value (rad or m) of every joint over the same poses.
std::vector<Interval> measured_ranges(const DataSet& data, const Calibration& calibration);

}  // namespace demecal
