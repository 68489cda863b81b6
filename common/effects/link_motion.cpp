#include "effects/link_motion.hpp"

#include "kinematics/elementary.hpp"

namespace demecal {
namespace {

constexpr double kParallel_rad = 0.02;

/// The frame in which the link's transform `parameter` acts, from where the link begins.
Eigen::Isometry3d frame_of(const Chain& chain, const Joint& joint, double q, LinkParameter parameter) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const Elementary& transform : elementary_transforms(chain.convention)) {
    if (transform.parameter == parameter) break;
    advance(frame, transform, elementary_value(joint, transform.parameter, q));
  }
  return frame;
}

const Elementary& transform_of(const Chain& chain, LinkParameter parameter) {
  const auto& all = elementary_transforms(chain.convention);
  std::size_t i = 0;
  while (all[i].parameter != parameter) ++i;
  return all[i];
}

}  // namespace

void append_link_motion(const Chain& chain, int joint, double q, LinkParameter parameter, int coefficient, double size,
                        std::vector<UnitMotion>& motions) {
  const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
  const Eigen::Isometry3d place = frame_of(chain, link, q, LinkParameter::theta);
  const Eigen::Isometry3d seen = place.inverse() * frame_of(chain, link, q, parameter);
  const Elementary& transform = transform_of(chain, parameter);
  const Eigen::Vector3d direction = seen.linear().col(transform.axis);
  const Eigen::Vector3d moved = transform.rotates ? seen.translation().cross(direction) : direction;
  const auto append = [&](int axis, double share) {
    if (share * size != 0.0) motions.push_back({coefficient, joint, axis, share * size});
  };
  for (int axis = 0; axis < 3; ++axis) append(axis, moved[axis]);
  for (int axis = 0; transform.rotates && axis < 3; ++axis) append(3 + axis, direction[axis]);
}

bool leads_between_parallels(const Chain& chain, int joint) {
  const int before = chain.convention == Convention::standard_dh ? joint : joint - 1;
  return near_parallel_to_next(chain, before, kParallel_rad);
}

}  // namespace demecal
