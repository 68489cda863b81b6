// Orientations in the check for a change: which of them a model can be compared
// with, and how far they scatter.
#pragma once

#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "updating/change_rows.hpp"

namespace demecal::inline updating {

/// Without the orientations of poses whose tool's turn the model does not know.
DataSet without_unknown_orientations(const CalibratedModel& model, DataSet data);

struct OrientationNoise {
  double noise_rad = 0.0;  ///< per axis
  double freedom = 0.0;    ///< as of so many rows that is known
};

/// What poses show of it once the model's covariance and all that may have changed are taken out: a model file states
/// none. By restricted maximum likelihood, the noise of positions being known.
OrientationNoise orientation_noise(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                   const std::vector<Effect>& effects);

}  // namespace demecal::inline updating
