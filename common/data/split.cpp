#include "data/split.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace demecal {
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

}  // namespace demecal
