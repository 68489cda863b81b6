#include "kinematics/point_motions.hpp"

#include <cstddef>

namespace demecal::inline kinematics {

PlacedScrews::PlacedScrews(const FixedTurns& turns, const JointVector& q) : joints_(turns.chain().size()) {
  const auto keep = [this](int joint, LinkParameter parameter, const Screw& screw) {
    screws_[static_cast<std::size_t>(joint * kLinkParameters + static_cast<int>(parameter))] = screw;
  };
  flange_ = walk(turns.chain(), turns, q, keep, [](int, Eigen::Isometry3d&) {});
}

PointMotions PlacedScrews::motions(const Eigen::Vector3d& point) const {
  PointMotions motions(3, joints_ * kLinkParameters);
  for (int column = 0; column < motions.cols(); ++column) {
    const Screw& screw = screws_[static_cast<std::size_t>(column)];
    if (screw.rotates)
      motions.col(column) = screw.direction.cross(point - screw.origin);
    else
      motions.col(column) = screw.direction;
  }
  return motions;
}

}  // namespace demecal::inline kinematics
