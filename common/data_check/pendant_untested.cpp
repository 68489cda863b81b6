#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/pendant.hpp"
#include "data_check/pendant_rounding.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline data_check {
namespace {

/// "joint 6", "joints 4 and 6".
std::string joints_text(const std::vector<int>& joints) {
  std::string text = joints.size() == 1 ? "joint " : "joints ";
  for (std::size_t i = 0; i < joints.size(); ++i)
    text += (i == 0 ? "" : i + 1 == joints.size() ? " and " : ", ") + std::to_string(joints[i] + 1);
  return text;
}

/// Joints of which the poses would agree with another sign, or another zero, as well: none of them, or too little,
/// moves the tool point.
std::vector<int> untested_joints(const DataSet& data, double told_m) {
  constexpr double kOtherZero = 0.1;  // rad or m
  std::vector<int> untested;
  for (int joint = 0; joint < data.robot.chain.size(); ++joint) {
    const auto changes = [&](double factor, double offset) {
      return std::ranges::any_of(data.poses, [&](const MeasuredPose& pose) {
        JointVector joints = pose.joints;
        joints[joint] = factor * joints[joint] + offset;
        const Eigen::Vector3d tool_m = nominal_tool(data, pose);
        const Eigen::Vector3d moved_m =
            forward(data.robot.chain, joints) * tool_m - forward(data.robot.chain, pose.joints) * tool_m;
        return moved_m.norm() > 2.0 * told_m;
      });
    };
    if (!changes(-1.0, 0.0) || !changes(1.0, kOtherZero)) untested.push_back(joint);
  }
  return untested;
}

}  // namespace

std::vector<std::string> left_open(const DataSet& data, double told_m) {
  std::vector<std::string> sentences;
  if (const std::vector<int> joints = untested_joints(data, told_m); !joints.empty()) {
    const bool one = joints.size() == 1;
    sentences.push_back(fmt::format(
        "These poses tell nothing of the sign or the zero of {}: with the described tool {} not move the points, or "
        "{} at zero in all of them. Set a tool off the last axis and its tool_mm, turn {} well, and read off again.",
        joints_text(joints), one ? "it does" : "they do", one ? "stands" : "stand", one ? "it" : "them"));
  }
  if (data.poses.size() < kFewestPendantPoses)
    sentences.push_back(fmt::format("So few poses ({}) agree with other descriptions too: read off {} at least.",
                                    data.poses.size(), kFewestPendantPoses));
  return sentences;
}

}  // namespace demecal::inline data_check
