#include "planning/travel.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kRadPerMetre = 2.0;

double length_of(const Chain& chain, const std::vector<PlannedPose>& poses, std::size_t from, std::size_t to) {
  return travel(chain, poses[from].joints, poses[to].joints);
}

void reverse_parts(const Chain& chain, const std::vector<PlannedPose>& poses, std::vector<std::size_t>& order) {
  constexpr double kShorter = 1e-9;
  const auto leg = [&](std::size_t i, std::size_t k) { return length_of(chain, poses, order[i], order[k]); };
  const std::size_t n = order.size();
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (std::size_t i = 0; i + 2 < n; ++i) {
      for (std::size_t k = i + 2; k < n; ++k) {
        const double now = leg(i, i + 1) + (k + 1 < n ? leg(k, k + 1) : 0.0);
        const double then = leg(i, k) + (k + 1 < n ? leg(i + 1, k + 1) : 0.0);
        if (then > now - kShorter) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i + 1),
                     order.begin() + static_cast<std::ptrdiff_t>(k + 1));
        shorter = true;
      }
    }
  }
}

double farthest(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  double most_m = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) most_m = std::max(most_m, (to[i] - from[i]).norm());
  return most_m;
}

}  // namespace

double travel(const Chain& chain, const JointVector& from, const JointVector& to) {
  double most = 0.0;
  for (int i = 0; i < chain.size(); ++i)
    most = std::max(most, std::abs(to[i] - from[i]) * (is_revolute(chain, i) ? 1.0 : kRadPerMetre));
  return most;
}

std::vector<std::size_t> short_order(const Chain& chain, const std::vector<PlannedPose>& poses) {
  std::vector<std::size_t> order;
  std::vector<bool> visited(poses.size(), false);
  for (std::size_t next = 0; order.size() < poses.size();) {
    order.push_back(next);
    visited[next] = true;
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t here = next;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (visited[i] || length_of(chain, poses, here, i) >= nearest) continue;
      nearest = length_of(chain, poses, here, i);
      next = i;
    }
  }
  reverse_parts(chain, poses, order);
  return order;
}

JointVector approach_stop(const FeasibleSpace& space, const PlannedPose& pose) {
  constexpr double kTurn_rad = radians(3.0), kSlide_m = 5e-3, kOfLimits = 0.015, kOfRange = 0.25;
  const Chain& chain = space.robot().chain;
  JointVector before = pose.joints;
  if (pose.approach.size() == 0) return before;
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    const Interval& range = space.ranges()[static_cast<std::size_t>(i)];
    const double usual = is_revolute(joint) ? kTurn_rad : kSlide_m;
    before[i] -= pose.approach[i] *
                 std::min({usual, kOfLimits * (joint.upper - joint.lower), kOfRange * (range.upper - range.lower)});
  }
  return before;
}

bool is_feasible(const FeasibleSpace& space, const PlannedPose& pose) {
  return space.obstruction(pose.joints) == Obstruction::none && is_free(space, approach_stop(space, pose), pose.joints);
}

Obstruction on_the_way(const FeasibleSpace& space, const JointVector& from, const JointVector& to) {
  constexpr double kStep = radians(5.0);
  constexpr double kMostLooks = 200.0;  // between two steps
  const int steps = 1 + static_cast<int>(travel(space.robot().chain, from, to) / kStep);
  const auto at = [&](double step) -> JointVector { return from + (to - from) * (step / steps); };
  std::vector<std::vector<Eigen::Vector3d>> ends;
  for (int i = 0; i <= steps; ++i) {
    const JointVector there = at(i);
    if (const Obstruction met = space.in_passing(there); met != Obstruction::none) return met;
    ends.push_back(space.part_ends(there));
  }
  const double thinnest_m = std::max(kLeastRadius_m, std::ranges::min(space.cell().radii_m));
  for (int i = 0; i < steps; ++i) {
    const auto before = static_cast<std::size_t>(i);
    const double looks = std::min(kMostLooks, std::ceil(farthest(ends[before], ends[before + 1]) / thinnest_m));
    for (int k = 1; k < looks; ++k)
      if (const Obstruction met = space.in_passing(at(i + k / looks)); met != Obstruction::none) return met;
  }
  return Obstruction::none;
}

bool is_free(const FeasibleSpace& space, const JointVector& from, const JointVector& to) {
  return on_the_way(space, from, to) == Obstruction::none;
}

}  // namespace demecal::inline planning
