#include <algorithm>
#include <map>

#include "preparation/programmed_poses.hpp"

namespace demecal {
namespace {

using PosesByKey = std::map<std::string, std::size_t>;

PosesByKey by_key(const std::vector<NamedPoint>& points, const std::string& file) {
  PosesByKey found;
  for (const NamedPoint& point : points) {
    if (!found.emplace(point.key, point.target).second) {
      throw InputError({file, 0}, point.name,
                       "is not the only pose of number " + point.key + "; name the array with pose_points");
    }
  }
  return found;
}

bool covers(const PosesByKey& poses, const std::vector<NamedPoint>& joints) {
  return std::all_of(joints.begin(), joints.end(), [&](const NamedPoint& point) { return poses.contains(point.key); });
}

/// The one array of poses beside the precision points that has a pose for every one of them, where there is just one.
std::optional<PosesByKey> beside(const Program& program, const std::vector<NamedPoint>& joints) {
  const bool any = std::any_of(program.targets.begin(), program.targets.end(),
                               [](const Target& target) { return target.is_pose(); });
  if (!any) return std::nullopt;
  std::map<std::string, std::vector<NamedPoint>> arrays;
  for (NamedPoint& point : named_points(program, PointKind::poses, "")) arrays[point.array].push_back(point);
  std::vector<PosesByKey> candidates;
  for (const auto& [array, points] : arrays) {
    PosesByKey poses = by_key(points, program.file);
    if (covers(poses, joints)) candidates.push_back(std::move(poses));
  }
  if (candidates.size() != 1) return std::nullopt;
  return candidates.front();
}

}  // namespace

std::vector<std::optional<std::size_t>> programmed_poses(const RawSet& set, const std::vector<NamedPoint>& joints) {
  std::optional<PosesByKey> poses;
  const PointFile& file = file_of_poses(set);
  const bool asked = set.poses || !set.pose_points.empty();
  if (asked) {
    poses = by_key(named_points(file.program, PointKind::poses, set.pose_points), file.program.file);
  } else {
    poses = beside(file.program, joints);
  }
  std::vector<std::optional<std::size_t>> targets(joints.size());
  for (std::size_t i = 0; poses && i < joints.size(); ++i) {
    const auto pose = poses->find(joints[i].key);
    if (pose == poses->end()) {
      throw InputError({file.program.file, 0}, joints[i].name, "has no programmed pose of the same number");
    }
    targets[i] = pose->second;
  }
  return targets;
}

}  // namespace demecal
