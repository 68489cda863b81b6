#include "kinematics/elementary.hpp"

#include <cmath>

namespace demecal {
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

const std::array<Elementary, kLinkParameters>& elementary_transforms(Convention convention) {
  return convention == Convention::standard_dh ? kStandard : kModified;
}

double elementary_value(const Joint& joint, LinkParameter parameter, double q) {
  const bool moves = parameter == (joint.type == JointType::revolute ? LinkParameter::theta : LinkParameter::d);
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

}  // namespace demecal
