#include "programs/stated_frames.hpp"

#include <algorithm>

namespace demecal {
namespace {

/// The last setting before `offset`; null where there is none.
const KnownFrame* last_before(const std::map<std::size_t, KnownFrame>& settings, std::size_t offset) {
  const auto after = settings.lower_bound(offset);
  return after == settings.begin() ? nullptr : &std::prev(after)->second;
}

bool same_tool(const StatedFrames& one, const StatedFrames& other) {
  if (one.unknown_tool != other.unknown_tool || one.tool.has_value() != other.tool.has_value()) return false;
  return !one.tool || one.tool->isApprox(*other.tool, 1e-9);
}

bool same_frame(const StatedFrames& one, const StatedFrames& other) {
  return one.unknown_frame == other.unknown_frame && one.base_from_frame.isApprox(other.base_from_frame, 1e-9);
}

}  // namespace

KnownFrame KnownFrame::computed(const std::string& what) {
  return {what, Eigen::Isometry3d::Identity(), what + " is computed when the program runs"};
}

void set_tool(StatedFrames& frames, const KnownFrame& tool) {
  frames.tool_name = tool.name;
  frames.unknown_tool = tool.unknown;
  frames.tool.reset();
  if (tool.unknown.empty()) frames.tool = tool.pose;
}

void set_frame(StatedFrames& frames, const KnownFrame& frame) {
  frames.frame = frame.name;
  frames.unknown_frame = frame.unknown;
  frames.base_from_frame = frame.pose;
}

StatedFrames FrameSettings::at(std::size_t offset) const {
  StatedFrames frames;
  if (const KnownFrame* tool = last_before(tools_, offset)) set_tool(frames, *tool);
  if (const KnownFrame* frame = last_before(frames_, offset)) set_frame(frames, *frame);
  return frames;
}

void take_uses(const std::vector<TargetUse>& uses, Target& target) {
  const auto first = std::min_element(
      uses.begin(), uses.end(), [](const TargetUse& one, const TargetUse& other) { return one.begin < other.begin; });
  target.order = first->begin;
  target.frames = first->frames;
  target.motion = Motion::line;
  for (const TargetUse& use : uses) {
    if (use.motion == Motion::joints) target.motion = Motion::joints;
    if (!same_tool(use.frames, first->frames)) target.frames.unknown_tool = "it is moved to with different tools";
    if (!same_frame(use.frames, first->frames)) target.frames.unknown_frame = "it is moved to in different frames";
  }
}

}  // namespace demecal
