#include "data/written_steps.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline data {

double decimal_step(const std::vector<double>& values, double unit) {
  for (int decimals = 0; decimals <= 5; ++decimals) {
    for (const double times : {5.0, 2.5, 2.0, 1.0}) {
      const double step = times * unit * std::pow(10.0, -decimals);
      const auto is_multiple = [step](double value) {
        return std::abs(value / step - std::round(value / step)) < 1e-3;
      };
      if (std::ranges::all_of(values, is_multiple)) return step;
    }
  }
  return 0.0;
}

JointSteps joint_steps(const Chain& chain, const std::vector<JointVector>& joints) {
  std::vector<double> angles, slides;
  for (const JointVector& one : joints)
    for (int joint = 0; joint < chain.size(); ++joint)
      (is_revolute(chain, joint) ? angles : slides).push_back(one[joint]);
  return {std::max(decimal_step(angles, radians(1.0)), decimal_step(angles, 1.0)), decimal_step(slides, metres(1.0))};
}

double rounding_m2(const Chain& chain, const JointVector& joints, const Eigen::Vector3d& point_m,
                   const JointSteps& steps) {
  constexpr double kOfStep2 = 1.0 / 12.0;
  const Jacobian jacobian = joint_jacobian(chain, joints, point_m);
  double squares = 0.0;
  for (int joint = 0; joint < chain.size(); ++joint)
    squares += jacobian.col(joint).head<3>().squaredNorm() * std::pow(steps.of(chain, joint), 2);
  return kOfStep2 * squares;
}

}  // namespace demecal::inline data
