// The mean of several robots of one type, as a model whose covariance is how far a further robot may be from it.
#pragma once

#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"

namespace demecal::inline updating {

struct NamedModel {
  std::string file;
  CalibratedModel model;
};

/// Links, coefficients of effects and joint corrections on average over the robots: the base none, the tool the
/// drawing's, effects those that any of the models has (a model without one counts as zero for it), corrections over
/// the range that all know. The posterior is the spread of the robots about it and what so few robots leave open of the
/// mean and the spread; how each model was measured is taken into account by its own posterior. Throws InputError,
/// naming the file, at fewer than two models, at arms that differ as their makers describe them, at models of the same
/// data, and at models without a posterior.
CalibratedModel fleet_model(const std::vector<NamedModel>& models);

/// Throws InputError where the model is a fleet's mean and `what` ("check") needs that of one robot.
void require_one_robot(const CalibratedModel& model, const std::string& file, const std::string& what);

}  // namespace demecal::inline updating
