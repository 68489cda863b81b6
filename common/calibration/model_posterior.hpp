// What a finished model is surely known by: its numbers' covariance, and how far its joints were moved to find it.
#pragma once

#include "calibration/calibrated_model.hpp"
#include "calibration/calibration.hpp"
#include "fitting/observation.hpp"

namespace demecal {

/// The covariance of the model's numbers over the poses it was fitted to: of base, links, tools and effects, and of
/// what smooth terms could still change in corrections that are declared. Along what the poses do not show it is as
/// wide as makers' figures are uncertain (FitOptions), 10 mm and 0.1 rad for tools.
Posterior posterior_of(const DataSet& data, const DeclaredModel& declared, const Calibration& calibration);

/// The posterior of a robot that was fitted to `poses`, and how far their rows scatter about it (standard deviations
/// for the degrees of freedom that the model leaves; m, rad, m).
struct FittedPosterior {
  Posterior posterior;
  RowScales scatter{};
};
FittedPosterior fitted_posterior(const DataSet& data, const DeclaredModel& declared, const CorrectedRobot& robot,
                                 const std::vector<std::size_t>& poses);

/// The lowest and highest value (rad or m) of every joint over the same poses.
std::vector<Interval> measured_ranges(const DataSet& data, const Calibration& calibration);

}  // namespace demecal
