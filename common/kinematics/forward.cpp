#include "kinematics/forward.hpp"

#include "errors/check.hpp"
#include "kinematics/elementary.hpp"

namespace demecal {
namespace {

/// An elementary transform's axis in the base frame: its direction and a point on it.
struct Screw {
  bool rotates;
  Eigen::Vector3d direction;
  Eigen::Vector3d origin;
};

/// Walks the chain from base to flange and hands every elementary transform's screw to `visit(joint, parameter,
/// screw)`.
template <typename Visit>
Eigen::Isometry3d walk(const Chain& chain, const JointVector& q, Visit visit) {
  DEMECAL_CHECK(q.size() == chain.size(), q.size() << " joint values for " << chain.size() << " joints");
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto& transforms = elementary_transforms(chain.convention);
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    for (const Elementary& transform : transforms) {
      visit(joint, transform.parameter,
            Screw{transform.rotates, frame.linear().col(transform.axis), frame.translation()});
      advance(frame, transform, elementary_value(link, transform.parameter, q[joint]));
    }
  }
  return frame;
}

/// The motion of `point` per unit of the screw's parameter: linear, then angular.
Eigen::Matrix<double, 6, 1> twist_at(const Screw& screw, const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 6, 1> twist;
  if (screw.rotates) {
    twist << screw.direction.cross(point - screw.origin), screw.direction;
  } else {
    twist << screw.direction, Eigen::Vector3d::Zero();
  }
  return twist;
}

int moving_column(const Chain& chain, int joint) {
  const bool revolute = chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
  return joint * kLinkParameters + static_cast<int>(revolute ? LinkParameter::theta : LinkParameter::d);
}

}  // namespace

Eigen::Isometry3d forward(const Chain& chain, const JointVector& q) {
  return walk(chain, q, [](int, LinkParameter, const Screw&) {});
}

Eigen::Vector3d tool_position(const Chain& chain, const JointVector& q) {
  return forward(chain, q) * chain.tool_m;
}

Kinematics differential_kinematics(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  std::array<Screw, kMaxJoints * kLinkParameters> screws;
  Kinematics result;
  result.flange = walk(chain, q, [&](int joint, LinkParameter parameter, const Screw& screw) {
    screws[static_cast<std::size_t>(joint * kLinkParameters + static_cast<int>(parameter))] = screw;
  });
  const Eigen::Vector3d point = result.flange * point_m;
  result.links.resize(6, chain.size() * kLinkParameters);
  for (int column = 0; column < result.links.cols(); ++column) {
    result.links.col(column) = twist_at(screws[static_cast<std::size_t>(column)], point);
  }
  result.joints.resize(6, chain.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    result.joints.col(joint) = result.links.col(moving_column(chain, joint));
  }
  return result;
}

Jacobian joint_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).joints;
}

LinkJacobian link_jacobian(const Chain& chain, const JointVector& q, const Eigen::Vector3d& point_m) {
  return differential_kinematics(chain, q, point_m).links;
}

}  // namespace demecal
