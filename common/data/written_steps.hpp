// How coarsely a table's numbers are written, and how far that alone puts the tool.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/chain.hpp"

namespace demecal::inline data {

/// The coarsest step that all values are written to: 5, 2.5, 2 or 1 times a decimal place of a unit, at most 5 units; 0
/// where they are written finer than 1e-5 units.
double decimal_step(const std::vector<double>& values, double unit);

/// The last places of joints: of those that turn, rad (written in degrees or radians), of those that slide, m (in mm).
struct JointSteps {
  double angle_rad = 0.0, slide_m = 0.0;

  double of(const Chain& chain, int joint) const { return is_revolute(chain, joint) ? angle_rad : slide_m; }
};

JointSteps joint_steps(const Chain& chain, const std::vector<JointVector>& joints);

/// The mean square, m^2, of what rounding to such steps moves a point fixed in the flange's frame by.
double rounding_m2(const Chain& chain, const JointVector& joints, const Eigen::Vector3d& point_m,
                   const JointSteps& steps);

}  // namespace demecal::inline data
