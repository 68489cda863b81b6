#include "planning/travel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

/// One stop between that makes the way free, the shortest of several; nothing where none was found.
std::optional<JointVector> detour(const FeasibleSpace& space, const JointVector& from, const JointVector& to,
                                  RandomStream& random) {
  constexpr int kTries = 200;
  const Chain& chain = space.robot().chain;
  std::optional<JointVector> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTries; ++i) {
    const JointVector between = i == 0 && space.robot().home.size() > 0 ? space.robot().home : space.draw(random);
    const double length = travel(chain, from, between) + travel(chain, between, to);
    if (length >= shortest || !is_free(space, from, between) || !is_free(space, between, to)) continue;
    shortest = length;
    best = between;
  }
  return best;
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

JointVector approach_stop(const Chain& chain, const PlannedPose& pose) {
  constexpr double kTurn_rad = radians(3.0), kSlide_m = 5e-3, kOfRange = 0.015;
  JointVector before = pose.joints;
  if (pose.approach.size() == 0) return before;
  for (int i = 0; i < chain.size(); ++i) {
    const Joint& joint = chain.joints[static_cast<std::size_t>(i)];
    const double usual = is_revolute(joint) ? kTurn_rad : kSlide_m;
    before[i] -= pose.approach[i] * std::min(usual, kOfRange * (joint.upper - joint.lower));
  }
  return before;
}

bool is_feasible(const FeasibleSpace& space, const PlannedPose& pose) {
  return space.obstruction(pose.joints) == Obstruction::none &&
         space.in_passing(approach_stop(space.robot().chain, pose)) == Obstruction::none;
}

bool is_free(const FeasibleSpace& space, const JointVector& from, const JointVector& to) {
  constexpr double kStep = radians(5.0);
  const int steps = 1 + static_cast<int>(travel(space.robot().chain, from, to) / kStep);
  for (int i = 1; i <= steps; ++i) {
    const JointVector there = from + (to - from) * (static_cast<double>(i) / steps);
    if (space.in_passing(there) != Obstruction::none) return false;
  }
  return true;
}

MeasuringWay way_along(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream random) {
  MeasuringWay way;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const JointVector before = approach_stop(space.robot().chain, poses[i]);
    if (i > 0 && !is_free(space, poses[i - 1].joints, before)) {
      if (const auto between = detour(space, poses[i - 1].joints, before, random))
        way.stops.push_back({*between});
      else
        way.blocked.push_back(i);
    }
    if (before != poses[i].joints) way.stops.push_back({before});
    way.stops.push_back({poses[i].joints, static_cast<int>(i)});
  }
  return way;
}

}  // namespace demecal::inline planning
