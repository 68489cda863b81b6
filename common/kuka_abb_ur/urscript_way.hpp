// Universal Robots URScript: which tool of set_tcp() holds at a motion, whatever way the program takes there.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// Follows functions, one inside another or not, threads, branches, loops and calls; the code outside all functions is
/// a routine, too.
class UrScriptWay {
 public:
  explicit UrScriptWay(const ProgramText& text);

  /// Every word in the order of the text, and behind that of set_tcp() its tool; then finish().
  void read_word(std::size_t begin, std::size_t end);
  void set_tool(std::size_t begin, const KnownFrame& tool) { flow_.set_tool(begin, tool); }
  void finish() { flow_.finish(); }
  const FrameFlow& flow() const { return flow_; }

  /// What holds for a motion, of a pose or of joints.
  StatedFrames held(std::size_t begin, bool by_pose);
  /// The word by which the program displaces motions; empty: none does.
  const std::string& displaces() const { return displaces_; }
  /// When all targets are known: where functions end what is known of the arm, and once which calls of functions that
  /// are not here were taken to leave the tool as it is.
  void note_routines(Program& program) const;

 private:
  bool read_control(std::string_view word, std::size_t begin, std::size_t end);
  void read_call(std::size_t begin, std::size_t end);
  void read_calls(std::size_t begin, std::size_t end);
  std::size_t expression_end(std::size_t begin, char sign) const;
  std::string word_before(std::size_t begin) const;

  const ProgramText& text_;
  FrameFlow flow_{"the tool of set_tcp", ""};
  std::size_t read_up_to_ = 0;
  std::string displaces_;
  std::vector<std::size_t> untold_;           ///< where the arm is moved by no target
  std::vector<bool> open_;                    ///< whether each block that is not ended is a routine
  std::map<std::size_t, std::string> calls_;  ///< that may be of functions elsewhere
  std::set<std::size_t> believed_;            ///< calls that a tool was believed through
};

}  // namespace demecal::inline kuka_abb_ur
