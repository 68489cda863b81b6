// A model found before, brought up to date by new poses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/prior_model.hpp"

namespace demecal::inline updating {

struct Update {
  CorrectedRobot robot;
  FittedPosterior fitted;  ///< of its numbers, and how rows scatter about it
  std::vector<ParameterEstimate> estimates;
  PartFactors factors{};            ///< by which the new poses multiply the variance of what may have changed
  double noise_factor = 1.0;        ///< the same of the rows' variance
  bool base_and_tool_only = false;  ///< nothing else that the model says could be improved on
  std::optional<Moved> moved;       ///< what alone changed, if the model was updated so
  std::vector<std::size_t> gross;   ///< poses that were left out as gross errors
  std::vector<std::string> sentences;
};

/// The most probable model after `poses` (Gauss and Newton's steps, far poses down-weighted): base and tool free, links
/// and effects believed as the model states them, widened by drift, joints to ripple outside its range as they do
/// within. How much of each has changed is told by the likelihood of the new poses. Where leaving poses out in turn
/// shows base and tool alone to do better, it is these alone; where it shows that of what single_change() finds, it is
/// that.
Update updated(const CalibratedModel& model, const CorrectedRobot& placed, const DataSet& data,
               const std::vector<std::size_t>& poses, const DeclaredModel& declared, const AssumedDrift& drift = {});

}  // namespace demecal::inline updating
