// The tools and frames that a program sets as it goes, and how several uses of one target agree.
#pragma once

#include <map>
#include <vector>

#include "programs/program.hpp"

namespace demecal {

/// A frame in a program: its pose, or why it has none that can be known.
struct KnownFrame {
  std::string name{};  ///< as the program has it
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::string unknown{};  ///< empty: `pose` is known

  static KnownFrame computed(const std::string& what);  ///< "WHAT is computed when the program runs"
};

void set_tool(StatedFrames& frames, const KnownFrame& tool);
void set_frame(StatedFrames& frames, const KnownFrame& frame);

/// Settings that hold from where they stand to the next.
class FrameSettings {
 public:
  void tool_from(std::size_t begin, const KnownFrame& tool) { tools_.insert_or_assign(begin, tool); }
  void frame_from(std::size_t begin, const KnownFrame& frame) { frames_.insert_or_assign(begin, frame); }
  StatedFrames at(std::size_t offset) const;

 private:
  std::map<std::size_t, KnownFrame> tools_, frames_;
};

/// One motion to a target.
struct TargetUse {
  std::size_t begin = 0;  ///< of the motion in the text
  Motion motion = Motion::joints;
  StatedFrames frames{};
};

/// Gives the target what its uses (at least one) say: the place of the first, a line only where all are lines, and
/// their frames, unknown where they differ.
void take_uses(const std::vector<TargetUse>& uses, Target& target);

}  // namespace demecal
