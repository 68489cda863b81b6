#include "kinematics/chain.hpp"

#include <cmath>
#include <iterator>

#include "errors/check.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline kinematics {
namespace {

constexpr std::array<Elementary, kLinkParameters> kStandard{{{LinkParameter::theta, true, 2},
                                                             {LinkParameter::d, false, 2},
                                                             {LinkParameter::a, false, 0},
                                                             {LinkParameter::alpha, true, 0},
                                                             {LinkParameter::beta, true, 1}}};
constexpr std::array<Elementary, kLinkParameters> kModified{{{LinkParameter::alpha, true, 0},
                                                             {LinkParameter::a, false, 0},
                                                             {LinkParameter::beta, true, 1},
                                                             {LinkParameter::theta, true, 2},
                                                             {LinkParameter::d, false, 2}}};

}  // namespace

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

JointVector driven_joints(const Chain& chain, JointVector commanded) {
  if (chain.couplings.empty()) return commanded;
  JointVector driven = commanded;
  for (const CommandCoupling& coupling : chain.couplings)
    driven[coupling.joint] += coupling.factor * commanded[coupling.from];
  return driven;
}

JointVector commanded_joints(const Chain& chain, JointVector driven) {
  // By joint, so that those that a coupling comes from are commands already.
  for (const CommandCoupling& coupling : chain.couplings)
    driven[coupling.joint] -= coupling.factor * driven[coupling.from];
  return driven;
}

JointVector joints_from_deg_or_mm(const Chain& chain, std::span<const double> values) {
  DEMECAL_CHECK(std::ssize(values) == chain.size(), values.size() << " values, " << chain.size() << " joints");
  JointVector joints(chain.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    joints[static_cast<Eigen::Index>(i)] = is_revolute(chain.joints[i]) ? radians(values[i]) : metres(values[i]);
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

bool leads_between_parallels(const Chain& chain, int link, double tolerance_rad) {
  const int before = chain.convention == Convention::standard_dh ? link : link - 1;
  return near_parallel_to_next(chain, before, tolerance_rad);
}

const std::array<Elementary, kLinkParameters>& elementary_transforms(Convention convention) {
  return convention == Convention::standard_dh ? kStandard : kModified;
}

double elementary_value(const Joint& joint, LinkParameter parameter, double q) {
  const bool moves = parameter == moving_parameter(joint);
  return joint.parameter(parameter) + (moves ? q : 0.0);
}

void advance(Eigen::Isometry3d& frame, const Elementary& transform, double value) {
  if (value == 0.0) return;
  auto rotation = frame.linear();
  if (!transform.rotates) {
    frame.translation() += value * rotation.col(transform.axis);
    return;
  }
  // A rotation about one own axis mixes the two columns that follow it cyclically.
  const double cosine = std::cos(value), sine = std::sin(value);
  const int first = (transform.axis + 1) % 3, second = (transform.axis + 2) % 3;
  const Eigen::Vector3d old_first = rotation.col(first), old_second = rotation.col(second);
  rotation.col(first) = cosine * old_first + sine * old_second;
  rotation.col(second) = cosine * old_second - sine * old_first;
}

}  // namespace demecal::inline kinematics
