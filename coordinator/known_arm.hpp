// A model and a data set that are put together must be of one arm.
#pragma once

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"

namespace demecal {

/// Throws InputError where the model has another number of joints than the data set's arm, or no tool for a target.
void require_same_arm(const CalibratedModel& model, const DataSet& data);

/// The same, and where its maker's figures are not those that the model was made from.
void require_same_nominal_arm(const CalibratedModel& model, const DataSet& data);

}  // namespace demecal
