// The way that the statements of VAL3 programs tell: branches, loops and calls.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/val3_program.hpp"

namespace demecal::inline staubli_kawasaki {

class Val3Way {
 public:
  /// Takes a program of this file in; `code` has no comments. Programs come in the order of the text.
  void read(const ProgramText& code, const Val3Code& program, std::size_t file);
  /// After all of them.
  void finish() { flow_.finish(); }
  /// Tells `program`, whose targets are known, where the motion before in the text is not, or not always, the one that
  /// the arm comes from.
  void note_arrivals(Program& program) const;

 private:
  void read_word(const ProgramText& code, std::size_t begin);

  FrameFlow flow_{"", ""};
  std::vector<std::size_t> stops_{};  ///< where motions may be stopped on their way, or are given up
};

}  // namespace demecal::inline staubli_kawasaki
