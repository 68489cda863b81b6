#include "data/repeated_names.hpp"

#include <map>
#include <string>
#include <utility>

namespace demecal::inline data {

void name_repeats(std::vector<MeasuredPose>& poses) {
  std::map<std::pair<PoseSet, std::vector<double>>, std::string> first;
  for (MeasuredPose& pose : poses) {
    const std::vector<double> joints(pose.joints.begin(), pose.joints.end());
    pose.pose_id = first.try_emplace({pose.set, joints}, pose.pose_id).first->second;
  }
}

std::vector<MeasuredPose> in_lines_of(std::size_t table, const JoinedTables& joined, std::vector<MeasuredPose> poses) {
  for (std::size_t pose = 0; pose < poses.size(); ++pose)
    poses[pose].line = joined.tables[table].rows[joined.rows[pose][table]].line;
  return poses;
}

}  // namespace demecal::inline data
