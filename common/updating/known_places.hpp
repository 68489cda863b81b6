// Where in a joint's turn a model found before knows what the joint does, and how well.
#pragma once

#include <vector>

#include "closed_calibration/calibrated_model.hpp"

namespace demecal::inline updating {

struct KnownPlace {
  double theta_rad = 0.0, variance = 0.0;  ///< of the joint's error there, rad^2
};

/// Two degrees apart, of a revolute joint, from 0: the better known the more of the model's poses stood there. Of
/// models that do not say how many, and of fleets, everything within the measured range, alike.
std::vector<KnownPlace> known_places(const CalibratedModel& model, int joint);

}  // namespace demecal::inline updating
