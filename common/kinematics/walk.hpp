// The way along a chain from base to flange, one elementary transform after the other.
#pragma once

#include "errors/check.hpp"
#include "kinematics/elementary.hpp"
#include "kinematics/forward.hpp"

namespace demecal {

/// An elementary transform's axis in the base frame: its direction and a point on it.
struct Screw {
  bool rotates;
  Eigen::Vector3d direction;
  Eigen::Vector3d origin;
};

/// The motion of `point` per unit of the screw's parameter: linear, then angular.
inline Eigen::Matrix<double, 6, 1> twist_at(const Screw& screw, const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 6, 1> twist;
  if (screw.rotates) {
    twist << screw.direction.cross(point - screw.origin), screw.direction;
  } else {
    twist << screw.direction, Eigen::Vector3d::Zero();
  }
  return twist;
}

/// Walks the chain from base to flange. Every joint's axis frame, and last the flange, is handed to `displace(place,
/// frame)`, which may move it; every elementary transform's screw to `visit(joint, parameter, screw)`.
template <typename Visit, typename Displace>
Eigen::Isometry3d walk(const Chain& chain, const JointVector& q, const Visit& visit, const Displace& displace) {
  DEMECAL_CHECK(q.size() == chain.size(), q.size() << " joint values for " << chain.size() << " joints");
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto& transforms = elementary_transforms(chain.convention);
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    for (const Elementary& transform : transforms) {
      if (transform.parameter == LinkParameter::theta) displace(joint, frame);
      visit(joint, transform.parameter,
            Screw{transform.rotates, frame.linear().col(transform.axis), frame.translation()});
      advance(frame, transform, elementary_value(link, transform.parameter, q[joint]));
    }
  }
  displace(chain.size(), frame);
  return frame;
}

/// The screws met on the way, and the Jacobians of a point by them.
class ScrewList {
 public:
  void operator()(int joint, LinkParameter parameter, const Screw& screw) {
    screws_[static_cast<std::size_t>(joint * kLinkParameters + static_cast<int>(parameter))] = screw;
  }
  /// The Jacobians of the point `point_m` fixed in the flange frame, by all parameters and by the joints' variables.
  Kinematics kinematics(const Chain& chain, const Eigen::Isometry3d& flange, const Eigen::Vector3d& point_m) const;

 private:
  std::array<Screw, kMaxJoints * kLinkParameters> screws_;
};

}  // namespace demecal
