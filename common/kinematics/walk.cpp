#include "kinematics/walk.hpp"

namespace demecal {
namespace {

int moving_column(const Chain& chain, int joint) {
  const bool revolute = chain.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
  return joint * kLinkParameters + static_cast<int>(revolute ? LinkParameter::theta : LinkParameter::d);
}

}  // namespace

Kinematics ScrewList::kinematics(const Chain& chain, const Eigen::Isometry3d& flange,
                                 const Eigen::Vector3d& point_m) const {
  Kinematics result;
  result.flange = flange;
  const Eigen::Vector3d point = flange * point_m;
  result.links.resize(6, chain.size() * kLinkParameters);
  for (int column = 0; column < result.links.cols(); ++column) {
    result.links.col(column) = twist_at(screws_[static_cast<std::size_t>(column)], point);
  }
  result.joints.resize(6, chain.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    result.joints.col(joint) = result.links.col(moving_column(chain, joint));
  }
  return result;
}

}  // namespace demecal
