// KUKA KRL: the tools and bases that a program sets, and the targets that its motions name.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// What holds where: $TOOL and $BASE set to numbers or to TOOL_DATA[n] and BASE_DATA[n] of the file, BAS(#TOOL, n),
/// FDAT_ACT, and for targets that no motion of the file names, the FDAT that goes with them by name (XP1 and FP1).
/// Number 0 is the flange and the base. What one file sets is unknown in the others of the program, since nothing here
/// follows which is run first.
class KrlFrames {
 public:
  KrlFrames(const ProgramText& text, const ControllerData& controller);

  /// Completes a target that was read, by its name and place.
  void complete(Target& target) const;

 private:
  struct FrameNumbers {
    int tool = 0, base = 0;
    bool tool_on_robot = true;
    std::string unknown{};  ///< empty: the numbers are known
    bool operator==(const FrameNumbers&) const = default;
  };

  void forget_between_files();
  void read_data(std::size_t begin, std::size_t end);
  void read_statement(std::size_t begin, std::size_t end);
  void read_assignment(bool of_tool, std::size_t begin, std::size_t next);
  void read_bas(std::size_t begin, std::size_t open);
  void read_motion(const std::string& word, std::size_t begin, std::size_t next);
  void apply_data(std::size_t begin, const FrameNumbers& numbers);
  KnownFrame assigned(std::size_t at_value, const std::string& what) const;
  KnownFrame numbered(bool of_tool, int number) const;
  KnownFrame tool_of(const FrameNumbers& numbers) const;
  KnownFrame base_of(const FrameNumbers& numbers) const;

  const ProgramText& text_;
  const ControllerData& controller_;
  std::map<int, KnownFrame> tool_data_, base_data_;
  std::map<std::string, FrameNumbers> data_of_;  ///< by the FDAT's name
  FrameSettings settings_;
  std::map<std::string, std::vector<TargetUse>> uses_;
  std::map<std::size_t, Motion> motions_;  ///< where each begins
};

}  // namespace demecal::inline languages
