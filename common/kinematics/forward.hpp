// Where the flange and the tool are, also with every axis moved a little from its place; and the derivatives by every
// joint and link parameter.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "errors/check.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline kinematics {

/// 6 x n: rows 0-2 linear (m per rad or m), rows 3-5 angular (rad per rad or m), in the base frame.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints>;
/// 6 x (5 n): columns 5 i + LinkParameter of joint i, rows as in Jacobian.
using LinkJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints * kLinkParameters>;

/// Pose of the flange in the base frame at joint values `q` (rad or m; size chain.size()): the product of the link
/// transforms, thesis A.2.
Eigen::Isometry3d forward(const Chain& chain, const JointVector& q);

/// What a chain's joints do not change of its turns, worked out once for many poses. Keeps the chain by reference, as
/// it was.
class FixedTurns {
 public:
  explicit FixedTurns(const Chain& chain);

  const Chain& chain() const { return chain_; }
  const Turn& operator()(int joint, LinkParameter parameter) const {
    return turns_[static_cast<std::size_t>(joint * kLinkParameters + static_cast<int>(parameter))];
  }

 private:
  const Chain& chain_;
  std::array<Turn, kMaxJoints * kLinkParameters> turns_{};
};

/// The same, to the bit.
Eigen::Isometry3d forward(const FixedTurns& turns, const JointVector& q);

/// Position of the chain's tool point in the base frame, m.
Eigen::Vector3d tool_position(const Chain& chain, const JointVector& q);

/// The analytic Jacobian by the joint variables of the point `point_m` fixed in the flange frame: J_i = z_i x (p -
/// o_i).
Jacobian joint_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);

/// The analytic Jacobian of the same point by all link parameters, each taken as its elementary transform's twist.
LinkJacobian link_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);

/// Everything at once, for solvers: the flange pose, and both Jacobians for one point.
struct Kinematics {
  Eigen::Isometry3d flange;
  Jacobian joints;  ///< by the commanded joints
  Jacobian drives;  ///< by the turns of the drives: the same where the arm has no couplings
  LinkJacobian links;
};
/// What a Jacobian by commanded joints is by the turns of the drives.
Jacobian by_drives(const Chain& chain, Jacobian by_commands);
Kinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m);
/// The same, to the bit.
Kinematics differential_kinematics(const FixedTurns& turns, const JointVector& q, const Eigen::Vector3d& point_m);

/// A small rigid motion in the axes of the frame it moves: a shift (m) by the first three, after a turn by the rotation
/// vector (rad) of the last three about the shifted origin.
using SmallMotion = Eigen::Matrix<double, 6, 1>;
/// Column i < n: of the frame whose z is the axis of joint i, before the joint's own motion; column n: of the flange.
using PlaceMotions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints + 1>;

/// `frame` after the motion.
Eigen::Isometry3d moved(const Eigen::Isometry3d& frame, const SmallMotion& motion);

/// The twist (linear m, angular rad, base frame) of a point, given in the base frame, per unit of component `axis` of
/// the motion `motion` of `frame`.
SmallMotion unit_twist(const Eigen::Isometry3d& frame, const SmallMotion& motion, int axis,
                       const Eigen::Vector3d& point);

/// Pose of the flange in the base frame with the places moved; `motions` has chain.size() + 1 columns.
Eigen::Isometry3d forward(const Chain& chain, const JointVector& q, const PlaceMotions& motions);

/// The same with the Jacobians, and where the places stand (base frame) before their motions.
struct DisplacedKinematics {
  Kinematics kinematics;
  std::array<Eigen::Isometry3d, kMaxJoints + 1> places;
};
DisplacedKinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m,
                                            const PlaceMotions& motions);

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
/// frame)`, which may move it; every elementary transform's screw to `visit(joint, parameter, screw)`. `fixed(joint,
/// parameter)`: the turn of a transform that the joint does not change.
template <typename Fixed, typename Visit, typename Displace>
Eigen::Isometry3d walk(const Chain& chain, const Fixed& fixed, const JointVector& q, const Visit& visit,
                       const Displace& displace) {
  DEMECAL_CHECK(q.size() == chain.size(), q.size() << " joint values for " << chain.size() << " joints");
  const JointVector driven = driven_joints(chain, q);
  Eigen::Isometry3d frame = chain.base;
  const auto& transforms = elementary_transforms(chain.convention);
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    for (const Elementary& transform : transforms) {
      if (transform.parameter == LinkParameter::theta) displace(joint, frame);
      visit(joint, transform.parameter,
            Screw{transform.rotates, frame.linear().col(transform.axis), frame.translation()});
      if (transform.rotates && transform.parameter != moving_parameter(link)) {
        if (link.parameter(transform.parameter) != 0.0)
          rotate(frame, transform.axis, fixed(joint, transform.parameter));
      } else {
        advance(frame, transform, elementary_value(link, transform.parameter, driven[joint]));
      }
    }
  }
  frame = frame * chain.flange;
  displace(chain.size(), frame);
  return frame;
}

/// The same of one pose.
template <typename Visit, typename Displace>
Eigen::Isometry3d walk(const Chain& chain, const JointVector& q, const Visit& visit, const Displace& displace) {
  const auto fixed = [&](int joint, LinkParameter parameter) {
    return turn_by(chain.joints[static_cast<std::size_t>(joint)].parameter(parameter));
  };
  return walk(chain, fixed, q, visit, displace);
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

}  // namespace demecal::inline kinematics
