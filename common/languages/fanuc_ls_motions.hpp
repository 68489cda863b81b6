// FANUC .LS: which motions of the program's instructions name which positions, how, and with which frame and tool
// selected.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "languages/fanuc_ls_shifts.hpp"
#include "languages/labelled_way.hpp"
#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// Past the line that is this section's heading; the end where there is none.
std::size_t fanuc_section(const ProgramText& text, std::string_view heading);

/// Whether the program tracks a line: by its header, or by instructions such as LINE[..], SETTRIG and SELBOUND.
bool tracks_a_line(const ProgramText& text);

/// Whether the program moves the first group of motion: by its header, DEFAULT_GROUP, or where that is not there.
bool moves_first_group(const ProgramText& text, std::size_t instructions);

class FanucMotions {
 public:
  /// Takes instructions, [begin, end) of the code: what stands between /MN and /POS. Those that give positions a value
  /// are told to `changes`.
  void read(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes);

  /// Motions that name no position, and to what they go; empty: to a register.
  const std::map<std::size_t, std::string>& to_others() const { return others_; }

  /// Tells `program`, whose targets are known, where motions go elsewhere than to a position alone or may stop on the
  /// way, and where else it is not known where the arm comes from; and says which programs that are called between
  /// motions are not here.
  void note_way(const ProgramText& text, Program& program) const;

  /// The motions to each position.
  const std::map<int, std::vector<TargetUse>>& uses() const { return uses_; }

  /// Why position `number` is not what the arm is sent to; empty: it is, as far as the instructions tell.
  std::string not_sent_to(int number) const;

  /// Why the controller stops where it moves to a pose with these numbers of frame and tool (UF, UT), since others are
  /// selected there (UFRAME_NUM, UTOOL_NUM); empty: it does not, or what is selected is not certain.
  std::string stopped_by(const ProgramText& text, int number, const std::string& frame, const std::string& tool) const;

  /// Gives the position its place among the motions, and whether lines lead to it.
  void complete(int number, Target& target) const;

 private:
  void read_instruction(const ProgramText& text, std::size_t begin, std::size_t end, ChangedNames& changes);
  void read_motion(const ProgramText& text, std::size_t begin, std::size_t end);
  void read_way(const ProgramText& text, std::size_t begin, std::size_t end);
  void read_jumps(const ProgramText& text, std::size_t begin, std::size_t end);
  void read_call(const ProgramText& text, std::size_t begin, std::size_t name, std::size_t end);
  void read_action(const ProgramText& text, std::size_t begin, std::size_t end, bool conditional);

  std::map<int, std::vector<TargetUse>> uses_;
  std::map<std::size_t, std::string> others_;
  std::vector<std::size_t> elsewhere_;  ///< where motions go to none of the positions alone, or may stop before it
  std::map<int, std::string> not_sent_to_;
  std::map<std::size_t, std::string> compliant_;  ///< instructions behind which the arm gives way
  LabelledWay way_{"UTOOL_NUM", "UFRAME_NUM"};    ///< the numbers, as why frames are unknown
  FanucShifts shifts_{};
  std::string computed_numbers_{};  ///< why no position is certain; empty: all are
};

}  // namespace demecal::inline languages
