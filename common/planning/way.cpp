#include "planning/way.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "planning/roadmap.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {
namespace {

/// Joints that differ from `joints` by so much of their ranges.
JointVector beside(const FeasibleSpace& space, JointVector joints, double width, RandomStream& random) {
  for (std::size_t i = 0; i < space.ranges().size(); ++i) {
    const Interval& range = space.ranges()[i];
    double& value = joints[static_cast<Eigen::Index>(i)];
    value = std::clamp(value + width * (range.upper - range.lower) * random.normal(), range.lower, range.upper);
  }
  return rounded(space.robot().chain, std::move(joints));
}

/// Some near the first `count`, nearer and farther: ways out of where there is little room.
void add_beside(const FeasibleSpace& space, std::size_t count, RandomStream& random, std::vector<JointVector>& places) {
  constexpr std::size_t kMost = 1'500;
  constexpr std::array<double, 6> kWidths{0.02, 0.04, 0.08, 0.08, 0.15, 0.15};
  constexpr int kTries = 6;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < std::min(kWidths.size(), kMost / count); ++k) {
      for (int attempt = 0; attempt < kTries; ++attempt) {
        JointVector drawn = beside(space, places[i], kWidths[k], random);
        if (space.in_passing(drawn) != Obstruction::none) continue;
        places.push_back(std::move(drawn));
        break;
      }
    }
  }
}

/// The approach stops of all poses first, in their order; then places near them, the arm's home and others at random.
std::vector<JointVector> passing_places(const FeasibleSpace& space, const std::vector<PlannedPose>& poses,
                                        RandomStream& random) {
  constexpr std::size_t kRandom = 300;
  constexpr int kMostTries = 20'000;
  std::vector<JointVector> places;
  for (const PlannedPose& pose : poses) places.push_back(approach_stop(space, pose));
  add_beside(space, poses.size(), random, places);
  const JointVector& home = space.robot().home;
  if (home.size() > 0 && space.in_passing(home) == Obstruction::none) places.push_back(home);
  const std::size_t wanted = places.size() + kRandom;
  for (int i = 0; i < kMostTries && places.size() < wanted; ++i) {
    JointVector drawn = space.draw(random);
    if (space.in_passing(drawn) == Obstruction::none) places.push_back(std::move(drawn));
  }
  return places;
}

/// Poses that free ways join, and the stops before each.
struct JoinedPoses {
  std::vector<std::size_t> poses;
  std::vector<std::vector<JointVector>> before;
};

class WaySearch {
 public:
  WaySearch(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream random)
      : space_(space), poses_(poses), roadmap_(space, passing_places(space, poses, random)) {}

  /// Those of `among` that are reached from the first, in their order; takes them away.
  JoinedPoses take_joined(std::vector<std::size_t>& among) {
    JoinedPoses joined;
    std::vector<std::size_t> left;
    for (const std::size_t pose : among) {
      std::optional<std::vector<JointVector>> stops = std::vector<JointVector>{};
      if (!joined.poses.empty()) stops = stops_between(joined.poses.back(), pose);
      if (!stops) {
        left.push_back(pose);
        continue;
      }
      joined.poses.push_back(pose);
      joined.before.push_back(std::move(*stops));
    }
    among = std::move(left);
    return joined;
  }

 private:
  /// From one pose to another's approach stop.
  std::optional<std::vector<JointVector>> stops_between(std::size_t from, std::size_t to) {
    const JointVector& begin = poses_[from].joints;
    const JointVector end = approach_stop(space_, poses_[to]);
    if (is_free(space_, begin, end)) return std::vector<JointVector>{};
    auto way = roadmap_.between(from, to);
    if (!way) return std::nullopt;
    way->insert(way->begin(), approach_stop(space_, poses_[from]));
    way->push_back(end);
    return without_detours(begin, *way);
  }

  /// From each stop straight to the last that is freely reached; without the end.
  std::vector<JointVector> without_detours(const JointVector& begin, const std::vector<JointVector>& way) {
    std::vector<JointVector> stops;
    JointVector here = begin;
    for (std::size_t next = 0; next < way.size(); ++next) {
      for (std::size_t last = way.size() - 1; last > next; --last) {
        if (!is_free(space_, here, way[last])) continue;
        next = last;
        break;
      }
      here = way[next];
      if (next + 1 < way.size()) stops.push_back(here);
    }
    return stops;
  }

  const FeasibleSpace& space_;
  const std::vector<PlannedPose>& poses_;
  Roadmap roadmap_;
};

}  // namespace

MeasuringWay way_along(const FeasibleSpace& space, const std::vector<PlannedPose>& poses, RandomStream random) {
  WaySearch search(space, poses, random);
  std::vector<std::size_t> left(poses.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  JoinedPoses most;
  while (left.size() > most.poses.size()) {
    JoinedPoses joined = search.take_joined(left);
    if (joined.poses.size() > most.poses.size()) most = std::move(joined);
  }
  MeasuringWay way;
  std::vector<bool> reached(poses.size(), false);
  for (std::size_t i = 0; i < most.poses.size(); ++i) {
    const std::size_t pose = most.poses[i];
    reached[pose] = true;
    for (const JointVector& stop : most.before[i]) way.stops.push_back({stop});
    const JointVector before = approach_stop(space, poses[pose]);
    if (before != poses[pose].joints) way.stops.push_back({before});
    way.stops.push_back({poses[pose].joints, static_cast<int>(pose)});
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!reached[i]) way.blocked.push_back(i);
  return way;
}

}  // namespace demecal::inline planning
