// TOOL and BASE of VAL II and AS, whatever way a program takes to a motion.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline staubli_kawasaki {

/// The name of a program that stands at `begin`, in small letters; points belong to it.
std::string program_name(const ProgramText& text, std::size_t begin);

/// Whether a statement of this word moves the arm to where no location says, or changes the tool or a location.
bool moves_or_tells_anew(const std::string& word);

/// What stands behind TOOL and BASE is told by words without blanks; what they mean is looked up when all is read.
class LocationFrames {
 public:
  /// The program whose ".PROGRAM name" stands at `at` begins; an empty name: none does.
  void begin_program(const ProgramText& text, std::size_t at, const std::string& name);
  /// Takes a line of a program, [begin, end) of the code: its label, and the way that it tells.
  void read_line(const ProgramText& text, std::size_t begin, std::size_t end);
  void tool(std::size_t at, const std::string& word) {
    flow_.set_tool(at, {"TOOL", Eigen::Isometry3d::Identity(), word});
  }
  void base(std::size_t at, const std::string& word) {
    flow_.set_frame(at, {"BASE", Eigen::Isometry3d::Identity(), word});
  }
  void finish() { flow_.finish(); }
  const FrameFlow& flow() const { return flow_; }

  /// A word of tool() or base(), or why none holds; both empty: none is set before.
  struct Word {
    std::string word{}, unknown{};
  };
  struct Words {
    Word tool{}, base{};
  };
  /// What holds at a motion, which is of a pose or of joints.
  Words at(std::size_t offset, bool of_pose);
  /// When all targets are known: where programs end what is known of the arm, and once which calls of other files'
  /// programs were believed to leave tool and base alone.
  void note_routines(const ProgramText& text, Program& program) const;

 private:
  void read_way(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end);
  void call(const ProgramText& text, std::size_t at, std::size_t name);
  void computed_call(const ProgramText& text, std::size_t at, std::size_t end);

  FrameFlow flow_{"TOOL", "BASE"};
  std::map<std::size_t, std::string> calls_{};
  std::map<std::size_t, std::string> untold_{};  ///< motions without a location
  bool believed_ = false;
};

}  // namespace demecal::inline staubli_kawasaki
