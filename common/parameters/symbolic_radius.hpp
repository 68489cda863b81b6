// The radius about a corrected tool point as formulas of the joints, for exported code.
#pragma once

#include <map>
#include <vector>

#include "expression/bound.hpp"
#include "parameters/posterior.hpp"
#include "parameters/widening.hpp"
#include "prediction/corrected_arm.hpp"
#include "prediction/corrected_robot.hpp"
#include "symbolic/algebra.hpp"
#include "symbolic/radius_code.hpp"

namespace demecal::inline parameters {

/// As real_radius95_m() at stops whose payload is stated and whose time is not, for the robot's own tool. The robot has
/// no effects of an instrument, and the posterior no numbers of the base. `reference_celsius`: of the listing that the
/// code follows.
RadiusListing symbolic_radius(Algebra& algebra, const PredictionInterval& interval, const Posterior& posterior,
                              const CorrectedRobot& robot, const MeasuredJoints& measured, double reference_celsius);

}  // namespace demecal::inline parameters
