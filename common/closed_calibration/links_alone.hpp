// The arm of links alone that comes nearest to a model, for controllers that know no corrections and no effects.
#pragma once

#include "closed_calibration/calibrated_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline closed_calibration {

/// `links` is without corrections and effects; beside the model's own predictions at random poses of the measured
/// ranges, come to from either side with any payload of those measured, it moves the tool by so much.
struct LinksAlone {
  CorrectedRobot links;
  double mean_m = 0.0, most_m = 0.0;
  bool fitted = false;  ///< they are not the model's own
};

/// Of `robot`, the model in its own base: its own links or, where these come nearer, those that are fitted to what it
/// predicts with its corrections and effects (base and tool held).
LinksAlone links_alone(const CalibratedModel& model, const CorrectedRobot& robot);

}  // namespace demecal::inline closed_calibration
