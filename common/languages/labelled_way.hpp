// The way through programs of one file that jump to labels and call programs of other files, and where it leaves
// unknown where the arm comes from: FANUC's and Yaskawa's.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

class LabelledWay {
 public:
  /// What sentences call the tool and the frame; empty: no statement sets it.
  LabelledWay(std::string tool, std::string frame) : flow_(std::move(tool), std::move(frame)) {}

  /// Branches, loops, and what they select.
  FrameFlow& flow() { return flow_; }
  const FrameFlow& flow() const { return flow_; }

  void label(std::size_t at, const std::string& name);
  /// Empty: to a label whose name is computed.
  void jump(std::size_t at, const std::string& name, bool always);
  bool jumps_anywhere() const { return jumps_anywhere_; }
  void call(std::size_t at, const std::string& name);
  /// From here on it is not known where the arm comes from.
  void lose(std::size_t at) { lost_.push_back(at); }
  /// The arm moves to a position of the program.
  void motion(std::size_t at);

  /// Tells `program`, whose targets are known, where the motion before in the text is not, or not always, the one that
  /// the arm comes from; and names the programs that are called between motions.
  void note_arrivals(const ProgramText& text, Program& program) const;

 private:
  FrameFlow flow_;
  std::vector<std::size_t> labels_, lost_;
  std::map<std::size_t, std::string> calls_;  ///< what each is called by
  std::optional<std::size_t> first_motion_{}, last_motion_{};
  bool jumps_anywhere_ = false;
};

}  // namespace demecal::inline languages
