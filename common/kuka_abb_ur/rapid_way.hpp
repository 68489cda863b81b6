// The way that statements of RAPID tell through its routines: branches, loops and jumps.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// Tells `program`, whose motions are known, where its routines end what is known of the arm.
void end_at_rapid_routines(const ProgramText& text, Program& program);

class RapidWay {
 public:
  /// Both must outlive this.
  RapidWay(const ProgramText& text, FrameFlow& flow) : text_(text), flow_(flow) {}

  /// Words in small letters, in the order of the text.
  void read_word(std::size_t begin, const std::string& word);

 private:
  bool begins_line(std::size_t begin) const;
  void read_if(std::size_t begin);

  const ProgramText& text_;
  FrameFlow& flow_;
  std::optional<std::size_t> only_statement_{};  ///< the end of what is behind an IF without THEN
};

}  // namespace demecal::inline kuka_abb_ur
