#include "simulation/stance.hpp"

#include "errors/check.hpp"
#include "kinematics/elementary.hpp"

namespace demecal {
namespace {

LinkParameter moving(JointType type) {
  return type == JointType::revolute ? LinkParameter::theta : LinkParameter::d;
}

/// Whether the transform `parameter` is the first along or about the joint's axis: Rz in either convention.
bool opens_axis(LinkParameter parameter) {
  return parameter == LinkParameter::theta;
}

}  // namespace

Eigen::Quaterniond rotation_by(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector_rad / angle));
}

Stance stand(const Chain& chain, const JointVector& q, std::span<const Eigen::Vector3d> tilts) {
  DEMECAL_CHECK(q.size() == chain.size(), q.size() << " joint values for " << chain.size() << " joints");
  DEMECAL_CHECK(tilts.empty() || std::ssize(tilts) == chain.size(), tilts.size() << " tilts");
  Stance stance;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const Joint& joint = chain.joints[i];
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      if (opens_axis(transform.parameter)) {
        if (!tilts.empty()) frame.rotate(rotation_by(tilts[i]));
        stance.axes.push_back(frame);
      }
      const bool moves = transform.parameter == moving(joint.type);
      const double variable = moves ? q[static_cast<Eigen::Index>(i)] : 0.0;
      advance(frame, transform, joint.parameter(transform.parameter) + variable);
    }
    stance.links.push_back(frame);
  }
  return stance;
}

}  // namespace demecal
