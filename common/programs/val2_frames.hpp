// VAL II: the TOOL and BASE instructions of a program.
#pragma once

#include <vector>

#include "programs/stated_frames.hpp"

namespace demecal {

/// Collects the instructions line by line; points are not tied to motions here, so that one tool and one base must
/// serve all of them.
class Val2Frames {
 public:
  /// Takes a line of a program, [begin, end) of the code.
  void read_line(const ProgramText& text, std::size_t begin, std::size_t end);

  /// Gives the program's targets their frames; the location that TOOL names is taken out, for nothing moves to it.
  void complete(Program& program) const;

 private:
  std::vector<std::string> tools_, bases_;  ///< what stands behind each instruction, without spaces, in small letters
};

}  // namespace demecal
