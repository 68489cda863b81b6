#include "data/data_set.hpp"

#include "errors/check.hpp"

namespace demecal {

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

Eigen::Vector3d nominal_tool(const DataSet& data, const MeasuredPose& pose) {
  if (pose.target.empty()) return data.robot.chain.tool_m;
  const auto tool = data.tools_m.find(pose.target);
  DEMECAL_CHECK(tool != data.tools_m.end(), "target=" << pose.target);
  return tool->second;
}

}  // namespace demecal
