// ABB RAPID: what statements do with the targets that a program declares, besides moving to them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// How many targets a motion instruction begins with; 0 for words that are none.
std::size_t targets_of_rapid_motion(std::string_view word);

/// The numbers in "x, y, z", mm; nothing where they are others, or followed by what turns.
std::optional<Eigen::Vector3d> rapid_shift_m(const ProgramText& text, std::size_t begin, std::size_t end);
/// The ends of the arguments from `begin`: commas outside of brackets, and the semicolon (or end) last.
std::vector<std::size_t> argument_ends(std::string_view code, std::size_t begin);

/// Bytes of the text.
struct TextRange {
  std::size_t begin = 0, end = 0;
};

/// The motions that PDispSet and PDispOn displace: up to PDispOff where only simple statements stand between them, else
/// all of the program.
std::vector<TextRange> displaced_by_pdisp(const ProgramText& text);

/// Where ConfJ \Off or ConfL \Off stands in the program, robots need not take the configurations that targets state.
void forget_stated_configurations(const ProgramText& text, Program& program);

/// The numbers of a declared target are those that the robot is sent to where every statement that names it moves to
/// it, to Offs(...) or RelTool(...) of it, or copies it to another.
class RapidStatements {
 public:
  /// `text` must outlive this.
  RapidStatements(const ProgramText& text, Program& program);

 private:
  void read_motion(std::size_t end, std::size_t targets);
  void read_name(std::size_t begin, std::size_t end);
  /// \Corr and \Track: sensors shift the motion of the statement in which they stand.
  void read_guidance(std::size_t begin, std::size_t end);
  /// \TLoad: a load for the statement's motion alone.
  void read_load(std::size_t begin);
  void leave_handed_on();
  /// Says that a motion goes to none of the targets.
  void goes_elsewhere(const TextRange& range);
  bool holds_target(const TextRange& range) const;
  bool may_move_to(std::size_t begin, bool whole) const;
  /// Where the name's indices and components end.
  std::size_t after_parts(std::size_t end) const;
  /// Whether [begin, end) is the name alone, or Offs or RelTool of it; such an offset is judged.
  bool is_plain(std::size_t begin, std::size_t end, std::size_t name_begin, std::size_t name_end);
  void judge_offset(std::size_t begin, std::size_t end, std::string_view name);

  const ProgramText& text_;
  std::string_view code_;
  Program& program_;
  ChangedNames changes_;
  std::set<std::string> names_;            ///< of targets, in small letters and without indices
  std::set<std::string> declared_{};       ///< those that were declared up to here
  std::set<std::size_t> elsewhere_{};      ///< where destinations begin that are no targets
  std::vector<TextRange> destinations_{};  ///< the arguments of motions that say where to
};

}  // namespace demecal::inline kuka_abb_ur
