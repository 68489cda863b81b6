#include "kinematics/chain.hpp"

#include <cmath>

#include "errors/check.hpp"
#include "kinematics/units.hpp"

namespace demecal {

double& Joint::parameter(LinkParameter which) {
  switch (which) {
    case LinkParameter::theta:
      return theta_rad;
    case LinkParameter::d:
      return d_m;
    case LinkParameter::a:
      return a_m;
    case LinkParameter::alpha:
      return alpha_rad;
    case LinkParameter::beta:
      return beta_rad;
  }
  DEMECAL_CHECK(false, "link parameter " << static_cast<int>(which));
}

double Joint::parameter(LinkParameter which) const {
  return const_cast<Joint*>(this)->parameter(which);
}

JointVector joints_from_deg_or_mm(const Chain& chain, std::span<const double> values) {
  DEMECAL_CHECK(std::ssize(values) == chain.size(), values.size() << " values, " << chain.size() << " joints");
  JointVector joints(chain.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    joints[static_cast<Eigen::Index>(i)] =
        chain.joints[i].type == JointType::revolute ? radians(values[i]) : metres(values[i]);
  }
  return joints;
}

bool near_parallel_to_next(const Chain& chain, int joint, double tolerance_rad) {
  if (joint < 0 || joint + 1 >= chain.size()) return false;
  // The twist between two joint axes is the standard link's own alpha, and the next modified link's.
  const bool standard = chain.convention == Convention::standard_dh;
  const double alpha = chain.joints[static_cast<std::size_t>(standard ? joint : joint + 1)].alpha_rad;
  return std::abs(std::sin(alpha)) < std::sin(tolerance_rad);
}

}  // namespace demecal
