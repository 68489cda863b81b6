#include "programs/val2_frames.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "data/lower_case.hpp"
#include "programs/target_correction.hpp"

namespace demecal {
namespace {

std::string lower_name(const Target& target) {
  return lower_case(target.name);
}

/// BASE dx, dy, dz, turn: how the robot's base was moved in the world that points are in, mm and degrees about z; what
/// is left out is 0. The frame that points are in is the way back.
KnownFrame base_of(const std::string& argument) {
  std::array<double, 4> values{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < values.size() && begin <= argument.size(); ++i) {
    const std::size_t end = std::min(argument.find(',', begin), argument.size());
    if (end > begin) {
      const auto cell = cell_at(argument, begin, end - begin, {});
      if (!cell) return KnownFrame::computed("BASE");
      values[i] = cell->value;
    }
    begin = end + 1;
  }
  if (begin <= argument.size()) return KnownFrame::computed("BASE");
  Eigen::Isometry3d moved(
      Eigen::AngleAxisd(values[3] * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  moved.translation() = 1e-3 * Eigen::Vector3d(values[0], values[1], values[2]);
  return {"BASE", moved.inverse(), ""};
}

KnownFrame tool_of(const std::string& argument, const Program& program) {
  if (argument.empty() || argument == "null" || argument == "nulltool") {
    return {"flange", Eigen::Isometry3d::Identity(), ""};
  }
  const auto found = std::find_if(program.targets.begin(), program.targets.end(), [&](const Target& target) {
    return target.is_pose() && lower_name(target) == argument;
  });
  if (found == program.targets.end()) return KnownFrame::computed("TOOL");
  return {found->name, stated_tool_pose(*found), ""};
}

/// The only one of the arguments; nothing where they differ.
std::optional<std::string> only(const std::vector<std::string>& arguments) {
  const std::set<std::string> different(arguments.begin(), arguments.end());
  return different.size() == 1 ? std::optional(*different.begin()) : std::nullopt;
}

}  // namespace

void Val2Frames::read_line(const ProgramText& text, std::size_t begin, std::size_t end) {
  const std::string_view code = text.code();
  begin = text.skip_spaces(begin);
  while (begin < end && is_digit(code[begin])) ++begin;  // a label
  begin = text.skip_spaces(begin);
  if (begin >= end || !text.begins_word(begin)) return;
  const std::size_t word_end = std::min(text.word_end(begin), end);
  const std::string word = lower_case(code.substr(begin, word_end - begin));
  if (word != "tool" && word != "base") return;
  std::string argument = lower_case(code.substr(word_end, end - word_end));
  std::erase_if(argument, [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; });
  (word == "tool" ? tools_ : bases_).push_back(argument);
}

void Val2Frames::complete(Program& program) const {
  StatedFrames frames;
  if (!tools_.empty()) {
    const auto argument = only(tools_);
    set_tool(frames, argument ? tool_of(*argument, program)
                              : KnownFrame{"TOOL", Eigen::Isometry3d::Identity(), "several tools are set by TOOL"});
  }
  if (!bases_.empty()) {
    const auto argument = only(bases_);
    set_frame(frames, argument ? base_of(*argument)
                               : KnownFrame{"BASE", Eigen::Isometry3d::Identity(), "several bases are set by BASE"});
  }
  std::erase_if(program.targets, [&](const Target& target) {
    return std::find(tools_.begin(), tools_.end(), lower_name(target)) != tools_.end();
  });
  for (Target& target : program.targets) target.frames = frames;
}

}  // namespace demecal
