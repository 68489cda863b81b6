// The joint corrections of several robots of one type: their mean, and how each robot's differs from it, as waves over
// a joint's turn: what gears and encoders do beside effects with names.
#pragma once

#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// Cycles a turn: gears' errors are slower than 1 in 10 deg.
inline constexpr int kHighestWave = 32;

/// Shares of a joint's variance that its waves of n cycles have, cosine and sine alike; they add up to one over n.
double wave_share(int n);

/// Without what each correction is on average: that is a matter of the joint's zero.
struct FleetCurves {
  std::vector<JointCorrection> mean;         ///< by joint, over the range that all know; neutral without such a range
  std::vector<std::vector<double>> average;  ///< by robot and joint: of its correction over that range, rad or m
  std::vector<FleetCurve> curves;            ///< of revolute joints with a mean
};

/// A robot without a correction counts as one that is zero.
FleetCurves fleet_curves(std::span<const CalibratedModel* const> models);

}  // namespace demecal::inline updating
