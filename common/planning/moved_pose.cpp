#include "planning/moved_pose.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "planning/sockets.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kOneJoint = 0.5;   ///< share of tries that move a single joint, anywhere
constexpr double kOtherSide = 0.3;  ///< share of tries that come from sides drawn anew

}  // namespace

std::optional<PlannedPose> moved_pose(const FeasibleSpace& space, const std::vector<PlannedSocket>& sockets,
                                      const PlannedPose& pose, double width, RandomStream& random) {
  const std::vector<Interval>& ranges = space.ranges();
  PlannedPose tried = pose;
  const auto set = [&](std::size_t joint, double value) {
    tried.joints[static_cast<Eigen::Index>(joint)] = std::clamp(value, ranges[joint].lower, ranges[joint].upper);
  };
  if (random.chance(kOneJoint)) {
    const std::size_t joint = random.index(ranges.size());
    set(joint, random.real(ranges[joint].lower, ranges[joint].upper));
  } else {
    for (std::size_t joint = 0; joint < ranges.size(); ++joint)
      set(joint, tried.joints[static_cast<Eigen::Index>(joint)] +
                     width * (ranges[joint].upper - ranges[joint].lower) * random.normal());
  }
  const Chain& chain = space.robot().chain;
  if (pose.socket) {
    const auto touching = joints_touching(chain, tried.joints, sockets[*pose.socket].place_m);
    if (!touching) return {};
    tried.joints = *touching;
  }
  tried.joints = rounded(chain, tried.joints);
  if (random.chance(kOtherSide))
    for (double& sign : tried.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
  return tried;
}

}  // namespace demecal::inline planning
