// The points of a KRL program: which motions go to them, with which tool and base.
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kuka_abb_ur/krl_frames.hpp"
#include "kuka_abb_ur/krl_statements.hpp"
#include "parsed_programs/frame_flow.hpp"

namespace demecal::inline kuka_abb_ur {

std::set<std::string> krl_declared_poses(const ProgramText& text) {
  constexpr std::array<std::string_view, 11> kTypes{"pos", "e6pos", "axis", "e6axis", "frame", "real",
                                                    "int", "bool",  "char", "fdat",   "load"};
  std::set<std::string> poses, others;
  text.for_each_word([&](std::size_t begin, std::size_t end) {
    const std::string type = text.word_at(begin);
    const bool aggregate = text.next(end) == ':';  // {POS: X 1,..}
    if (aggregate || std::ranges::find(kTypes, type) == kTypes.end()) return;
    std::set<std::string>& names = type == "pos" || type == "e6pos" ? poses : others;
    const std::size_t line_end = std::min(text.code().find('\n', end), text.code().size());
    for (std::size_t at = end; at < line_end; at = next_krl_argument(text.code(), at, line_end))
      if (text.skip_spaces(at) < line_end) names.insert(text.word_at(at));
  });
  std::erase_if(poses, [&](const std::string& name) { return name.empty() || others.contains(name); });
  return poses;
}

void KrlFrames::take_points(const std::vector<Target>& targets) {
  for (const Target& target : targets) {
    const auto [stem, index] = krl_point_name(target.name);
    given_.give(stem + index, target.begin());
    if (index.empty() && target.name.size() > stem.size()) any_element_.insert(stem);
  }
}

/// The motions that may go to the target.
std::vector<TargetUse> KrlFrames::uses_of(const std::string& stem, const std::string& index, const Target& target) {
  std::vector<TargetUse> found;
  const auto uses = uses_.find(stem);
  if (stem.empty() || uses == uses_.end()) return found;
  for (const PointUse& point : uses->second) {
    const bool same = index == point.index, told = same && !any_element_.contains(stem);
    if (!same && !index.empty() && !point.index.empty()) continue;
    const auto one = told ? given_.at(stem + index, point.use.begin, flow_) : std::nullopt;
    if (one.value_or(target.begin()) != target.begin()) continue;
    if (!one) to_one_of_several_.push_back(point.use.begin);
    found.push_back(point.use);
    found.back().frames = held(point.use.begin, target.is_pose());
  }
  return found;
}

void KrlFrames::complete(Target& target) {
  const std::size_t begin = target.begin();
  const auto [name, index] = krl_point_name(target.name);
  target.order = begin;
  if (const std::vector<TargetUse> uses = uses_of(name, index, target); !uses.empty()) return take_uses(uses, target);
  if (!name.empty() && !motions_.empty()) never_moved_to_.push_back(begin);
  const auto after = motions_.upper_bound(begin);
  const std::size_t line = text_.place(begin).line;
  const bool in_motion = name.empty() && after != motions_.begin() && text_.place(std::prev(after)->first).line == line;
  if (in_motion) target.motion = std::prev(after)->second;
  const auto data = name.starts_with('x') ? data_of_.find('f' + name.substr(1)) : data_of_.end();
  target.frames = held(begin, target.is_pose() && in_motion);
  if (data == data_of_.end()) return;
  set_tool(target.frames, tool_of(data->second));
  set_frame(target.frames, base_of(data->second));
}

void KrlFrames::note_routines(Program& program) const {
  // A point that is given numbers is no motion to it.
  program.joints_lost_at.insert(program.joints_lost_at.end(), never_moved_to_.begin(), never_moved_to_.end());
  program.joints_lost_at.insert(program.joints_lost_at.end(), to_one_of_several_.begin(), to_one_of_several_.end());
  flow_.note_arrivals(program);
  program.payload_statements.insert(program.payload_statements.end(), loads_.begin(), loads_.end());
  if (!believed_.empty()) note_calls_elsewhere(text_, flow_.calls_elsewhere(), calls_, program);
}

}  // namespace demecal::inline kuka_abb_ur
