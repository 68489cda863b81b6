// The joint corrections of several robots of one type: their mean, and how each robot's differs from it.
#pragma once

#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// Without what each correction is on average: that is a matter of the joint's zero.
struct FleetCurves {
  std::vector<JointCorrection> mean;         ///< by joint, over the range that all know; neutral without such a range
  std::vector<std::vector<double>> average;  ///< by robot and joint: of its correction over that range, rad or m
  std::vector<FleetCurve> curves;            ///< of revolute joints with a mean
};

/// A robot without a correction counts as one that is zero.
FleetCurves fleet_curves(std::span<const CalibratedModel* const> models);

}  // namespace demecal::inline updating
