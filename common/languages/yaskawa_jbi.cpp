// Yaskawa (Motoman) jobs, .JBI: positions of //POS in Cartesian coordinates (///RECTAN: x, y, z in mm and Rx, Ry, Rz in
// degrees, turns about x, y, z that stay), in the frame that ///POSTYPE names, or in pulses (///PULSE) of the six
// joints, where it is stated elsewhere how many of them a degree has. Base axes (BC; in mm or pulses) and stations (EC)
// are kept; the former are the rails that carry an arm that has any.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "languages/labelled_way.hpp"
#include "languages/yaskawa_jbi_base.hpp"
#include "languages/yaskawa_jbi_way.hpp"
#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {
namespace {

/// Degrees have two decimals with some controllers, four with others.
constexpr CellUnit kJobAngle{std::numbers::pi / 180.0, 2};
constexpr std::size_t kPositionNumbers = 6;
constexpr const char* kRobotFrame = "robot";

/// What the lines above a position say of it.
struct JobSetting {
  bool pulses = true;
  std::string frame{}, user{}, tool{}, configuration{};
};

class JobReader {
 public:
  explicit JobReader(const ReaderInput& input)
      : text_(input.source, {}),
        code_(text_.text()),
        arm_(input.arm),
        controller_(input.controller),
        base_(input),
        rails_(base_.rails()) {}

  Program read() {
    always_shifts_ = job_jumps(text_);
    if (always_shifts_) shifts_ = all_job_shifts(text_);
    for (std::size_t begin = 0, end = 0; begin < code_.size(); begin = end + 1) {
      end = std::min(code_.find('\n', begin), code_.size());
      read_line(begin, end);
    }
    finish();
    return std::move(program_);
  }

 private:
  struct Position {
    std::string key;
    Target target;
    std::string why{};  ///< it is not corrected; empty: it is
  };
  struct Uses {
    std::vector<TargetUse> motions{};
    std::set<std::string> bases{};  ///< positions of the base axes that motions to it name; "": one names none
    std::string why{};
    bool given = false;  ///< by a position of the file
  };

  void read_line(std::size_t begin, std::size_t end) {
    begin = std::min(std::min(code_.find_first_not_of(" \t", begin), code_.size()), end);
    end = begin + code_.substr(begin, end - begin).find_last_not_of(" \t\r") + 1;
    if (begin == end || code_[begin] == '\'') return;
    if (code_.substr(begin, end - begin).starts_with("//")) return read_heading(begin, end);
    if (in_positions_) return read_position(begin, end);
    if (in_instructions_) read_instruction(begin, end);
  }

  /// "//POS", "//INST", "///TOOL 1" and the like.
  void read_heading(std::size_t begin, std::size_t end) {
    const std::string line = lower_case(code_.substr(begin, end - begin));
    const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
    const std::string word = line.substr(0, blank);
    std::string value = line.substr(blank);
    std::erase_if(value, [](char letter) { return letter == ' ' || letter == '\t'; });
    if (!word.starts_with("///")) {
      in_positions_ = word == "//pos";
      in_instructions_ = word == "//inst";
    }
    if (word == "///pulse") setting_.pulses = true;
    if (word == "///rectan") setting_.pulses = false;
    if (word == "///postype") setting_.frame = value;
    if (word == "///user") setting_.user = value;
    if (word == "///tool") setting_.tool = value;
    if (word == "///rconf") setting_.configuration = value;
    const bool second_robot = word.starts_with("///group") && word != "///group1" && value.find("rb") == 0;
    several_robots_ = several_robots_ || second_robot;
  }

  /// "C00001=500.000,0.000,300.000,180.0000,0.0000,0.0000".
  void read_position(std::size_t begin, std::size_t end) {
    const std::size_t sign = code_.find('=', begin);
    if (sign >= end) return text_.fail(begin, end - begin, "must be a position, NAME=NUMBERS");
    std::size_t first = begin;
    const std::string name(text_.trimmed(first, sign));
    base_axes_ = base_axes_ || lower_case(name).starts_with('b');
    base_.read(text_, name, sign + 1, end, setting_.pulses);
    const std::string key = robot_position_name(name);
    if (key.empty()) return;
    Position position{key, {.name = name, .place = text_.place(begin)}};
    if (setting_.pulses && controller_.pulses_per_deg.empty()) {
      position.why =
          "it is in pulses, and a job does not say how many of them a degree has; state it (pulses_per_deg of the "
          "robot's file, or --pulses-per-deg), or write the job with Cartesian positions (///POSTYPE BASE or ROBOT, "
          "///RECTAN)";
    } else {
      read_numbers(sign + 1, end, position);
    }
    positions_.push_back(std::move(position));
  }

  std::array<CellUnit, kPositionNumbers> units() const {
    std::array<CellUnit, kPositionNumbers> units{kMillimetres, kMillimetres, kMillimetres,
                                                 kJobAngle,    kJobAngle,    kJobAngle};
    for (std::size_t joint = 0; setting_.pulses && joint < units.size(); ++joint)
      units[joint] = {joint_units(arm_)[rails_ + joint].size / controller_.pulses_per_deg[rails_ + joint], 0};
    return units;
  }

  void read_numbers(std::size_t begin, std::size_t end, Position& position) const {
    const std::array<CellUnit, kPositionNumbers> units_of = units();
    std::vector<Cell> cells;
    for (std::size_t count = 0; begin <= end; ++count) {
      const std::size_t stop = std::min(code_.find(',', begin), end);
      std::size_t first = begin;
      const std::string_view number = text_.trimmed(first, stop);
      cells.push_back(text_.number(first, number.size(), units_of[std::min(count, kPositionNumbers - 1)]));
      begin = stop + 1;
    }
    Target& target = position.target;
    if (cells.size() != kPositionNumbers) {
      position.why = "it has " + std::to_string(cells.size()) + " numbers and not 6";
      return;
    }
    if (setting_.pulses) {
      target.joints = std::move(cells);
    } else {
      target.position.assign(cells.begin(), cells.begin() + 3);
      target.orientation.assign(cells.begin() + 3, cells.end());
      target.form = OrientationForm::fixed_xyz_angles;
      target.hint.configuration = setting_.configuration;
      if (!setting_.configuration.empty()) target.hint.counted_turns = {rails_, rails_ + 3, rails_ + 5};
    }
    set_frames(target);
  }

  void set_frames(Target& target) const {
    if (!setting_.tool.empty()) set_tool(target.frames, controller_.tool(setting_.tool, "tool " + setting_.tool));
    const std::string& frame = setting_.frame;
    if (target.position.empty() || frame == "base" || frame.empty()) return;
    if (frame == "robot") return set_frame(target.frames, {kRobotFrame, Eigen::Isometry3d::Identity(), ""});
    if (frame == "user")
      return set_frame(target.frames, controller_.frame(setting_.user, "user frame " + setting_.user));
    const std::string name = "frame " + frame;
    set_frame(target.frames, {name, Eigen::Isometry3d::Identity(), name + " is not given in this file"});
  }

  /// An instruction with the positions that it names.
  void read_instruction(std::size_t begin, std::size_t end) {
    const std::string word = lower_case(code_.substr(begin, text_.word_end(begin) - begin));
    read_job_way(text_, begin, end, way_);
    if (const auto [ending, why] = job_shift(word); !ending.empty()) shifts_[ending] = why;
    if (!always_shifts_) shifts_.erase(word);
    if (word == "settool" || word == "mframe") changes_of_controller_ = word;
    const bool motion = word.starts_with("mov"), coordinated = word.starts_with("smov"), relative = word == "imov";
    const bool shifted = motion && !shifts_.empty(), other = !motion && word.find("mov") != std::string::npos;
    bool named = false;
    const std::string base = motion ? JobBaseAxes::named(text_, begin, end) : "";
    for (std::size_t at = begin; at < end; ++at) {
      if (!text_.begins_word(at)) continue;
      const std::size_t word_end = std::min(text_.word_end(at), end);
      const std::string key = robot_position_name(code_.substr(at, word_end - at));
      // UNTIL IN#(1)=ON may stop it before it is there.
      if (motion && text_.word_at(at) == "until") program_.joints_lost_at.push_back(at);
      at = word_end - 1;
      if (key.empty()) continue;
      named = true;
      Uses& uses = uses_[key];
      if (motion) way_.motion(begin);
      if (motion) uses.bases.insert(base);
      if (motion && !shifted) {
        uses.motions.push_back({begin, word == "movj" ? Motion::joints : Motion::line, {}});
      } else if (motion || coordinated) {
        uses.why = shifted ? shifts_.begin()->second : "it is moved to in the frame of a station (" + word + ')';
      } else if (word != "refp") {
        uses.why = "it is used by " + word + ", which moves by it or changes it";
      }
    }
    if (!motion && word != "refp" && names_computed_position(text_, begin, end)) changes_any_ = word;
    if (relative || coordinated || shifted || (other && named)) program_.joints_lost_at.push_back(begin);
    if (motion && !named) note_computed(std::min(text_.skip_spaces(text_.word_end(begin)), end), end);
  }

  /// Says that the motion to what stands at `begin` goes to none of the positions.
  void note_computed(std::size_t begin, std::size_t end) {
    const std::string_view goal = code_.substr(begin, code_.substr(0, end).find_first_of(" \t", begin) - begin);
    note_unknown_motion(
        program_, begin, {.name = "", .place = text_.place(begin)},
        "the motion goes to '" + std::string(goal.substr(0, 40)) + "', which is computed when the program runs");
  }

  /// Makes targets of the positions, now that it is known what uses them.
  void finish() {
    for (Position& position : positions_) {
      Target& target = position.target;
      Uses& uses = uses_[position.key];
      uses.given = true;
      if (position.why.empty()) position.why = uses.why;
      const bool kept = !target.frames.tool_name.empty() || target.frames.tool || !target.frames.frame.empty();
      if (position.why.empty() && !changes_of_controller_.empty() && kept)
        position.why = "the job changes the controller's tools or user frames (" + changes_of_controller_ + ')';
      if (position.why.empty() && several_robots_) position.why = "the job moves several robots";
      if (position.why.empty() && !changes_any_.empty() && position.key.starts_with('P'))
        position.why = "it may be the one that " + changes_any_ + " changes, whose number is computed";
      if (position.why.empty() && uses.motions.empty() && position.key.starts_with('P'))
        position.why = "no motion of this job goes to it";
      if (position.why.empty()) position.why = base_.take(position.key, uses.bases, target);
      if (!position.why.empty()) {
        skip_target(program_, target, position.why);
        for (const TargetUse& use : uses.motions) program_.joints_lost_at.push_back(use.begin);
        continue;
      }
      if (rails_ > 0 && target.frames.frame == kRobotFrame) target.frames.base_from_frame = base_.robot_frame(target);
      if (rails_ == 0 && base_axes_ && target.is_pose() && target.frames.frame.empty())
        target.frames.unknown_frame = "base axes carry the arm";
      complete(uses.motions, target);
      program_.targets.push_back(std::move(target));
    }
    for (const auto& [key, uses] : uses_) {
      if (uses.given) continue;
      for (const TargetUse& use : uses.motions)
        note_unknown_motion(program_, use.begin, {.name = key, .place = text_.place(use.begin)},
                            "it is not given in this file");
    }
    way_.flow().finish();
    way_.note_arrivals(text_, program_);
  }

  static void complete(std::vector<TargetUse> motions, Target& target) {
    target.order = target.begin();
    if (motions.empty()) return;
    for (TargetUse& use : motions) use.frames = target.frames;
    take_uses(motions, target);
  }

  ProgramText text_;
  std::string_view code_;
  const Chain& arm_;
  const ControllerData& controller_;
  JobBaseAxes base_;
  std::size_t rails_;
  Program program_;
  JobSetting setting_;
  bool in_positions_ = false, in_instructions_ = false, several_robots_ = false, base_axes_ = false,
       always_shifts_ = false;
  std::map<std::string, std::string> shifts_{};  ///< why motions are shifted, by the instruction that ends it
  std::string changes_of_controller_;            ///< the instruction that does
  std::string changes_any_;                      ///< the one that may change any P
  std::vector<Position> positions_;
  std::map<std::string, Uses> uses_;  ///< by position_name
  LabelledWay way_{"", ""};
};

}  // namespace

Language yaskawa_jbi_language() {
  return {.name = "yaskawa_jbi",
          .title = "Yaskawa JBI",
          .file_endings = {"jbi"},
          .signs = {"///npos", "///postype"},
          .comment = "'",
          .longest_comment = 31,  // a comment has 32 letters at most
          .headers = {"nop"},
          .openings = {"/job"},
          .read = [](const ReaderInput& input) { return JobReader(input).read(); }};
}

}  // namespace demecal::inline languages
