#include "data/data_set.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "errors/check.hpp"

namespace demecal::inline data {
namespace {

std::vector<std::string> distinct_ids(std::span<const MeasuredPose> poses) {
  std::vector<std::string> ids;
  std::map<std::string, bool> seen;
  for (const MeasuredPose& pose : poses) {
    if (!std::exchange(seen[pose.pose_id], true)) ids.push_back(pose.pose_id);
  }
  return ids;
}

void shuffle(std::vector<std::string>& ids, const DrawIndex& draw) {
  for (std::size_t left = ids.size(); left > 1; --left) std::swap(ids[left - 1], ids[draw(left)]);
}

}  // namespace

std::string_view to_string(PoseSet set) {
  switch (set) {
    case PoseSet::calibration:
      return "calibration";
    case PoseSet::validation:
      return "validation";
    case PoseSet::accept:
      return "accept";
  }
  DEMECAL_CHECK(false, "set=" << static_cast<int>(set));
  return "";
}

std::vector<std::size_t> poses_of(const DataSet& data, PoseSet set) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    if (data.poses[i].set == set) indices.push_back(i);
  }
  return indices;
}

std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data,
                                                                std::span<const std::size_t> poses) {
  std::map<ContactGroup, std::vector<std::size_t>> groups;
  for (const std::size_t pose : poses)
    if (!data.poses[pose].contact.empty()) groups[group_of(data.poses[pose])].push_back(pose);
  return groups;
}

std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data) {
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return contact_groups(data, all);
}

bool has_contacts(const DataSet& data) {
  return std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return !pose.contact.empty(); });
}

bool has_instrument(const DataSet& data) {
  return std::ranges::any_of(data.poses, [](const MeasuredPose& pose) {
    return pose.position_m || pose.orientation || !pose.distances_m.empty();
  });
}

Eigen::Vector3d nominal_tool(const DataSet& data, const MeasuredPose& pose) {
  if (pose.target.empty()) return data.robot.chain.tool_m;
  const auto tool = data.tools_m.find(pose.target);
  DEMECAL_CHECK(tool != data.tools_m.end(), "target=" << pose.target);
  return tool->second;
}

void split_by_pose(std::span<MeasuredPose> poses, const SplitFractions& fractions, const DrawIndex& draw) {
  std::vector<std::string> ids = distinct_ids(poses);
  if (ids.empty()) return;
  shuffle(ids, draw);
  const auto share = [&](double fraction, std::size_t most) {
    return std::min(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(ids.size()))), most);
  };
  const std::size_t validation = share(fractions.validation, ids.size() - 1);
  const std::size_t accept = share(fractions.accept, ids.size() - 1 - validation);
  std::map<std::string, PoseSet> set_of;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    set_of[ids[i]] = i < validation            ? PoseSet::validation
                     : i < validation + accept ? PoseSet::accept
                                               : PoseSet::calibration;
  }
  for (MeasuredPose& pose : poses) pose.set = set_of[pose.pose_id];
}

}  // namespace demecal::inline data
