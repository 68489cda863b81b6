// FANUC .LS: between which instructions motions are shifted when the program runs: Touch Offset, MP Offset and Track.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

class FanucShifts {
 public:
  /// Takes an instruction, [begin, end) of the code; they come in the order of the text.
  void read(const ProgramText& text, std::size_t begin, std::size_t end);

  /// Why a motion behind the instructions read so far does not go to its position; empty: it does.
  const std::string& why() const { return why_; }

  /// When all are read: why motions may be shifted that do not stand between such instructions, since the program goes
  /// from between them to elsewhere by other ways than line by line; empty: it does not.
  std::string anywhere() const;

 private:
  void read_word(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end);

  std::string why_{};
  std::vector<std::string> blocks_{};  ///< why motions were shifted where those that are open began
  std::map<std::string, std::string> at_labels_{};
  std::vector<std::pair<std::string, std::string>> at_jumps_{};  ///< to a label, and why motions were shifted there
  std::string by_blocks_{};
};

}  // namespace demecal::inline languages
