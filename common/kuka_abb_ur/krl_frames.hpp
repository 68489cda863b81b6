// KUKA KRL: the tools and bases that a program sets, and the targets that its motions name.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/given_numbers.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// The frame of `$BASE=$ROBROOT`.
inline constexpr const char* kKrlRobotRoot = "$ROBROOT";

/// What holds where: $TOOL and $BASE set to numbers or to TOOL_DATA[n] and BASE_DATA[n] of the file, BAS(#TOOL, n),
/// FDAT_ACT, and for targets that no motion of the file names, the FDAT that goes with them by name (XP1 and FP1).
/// Number 0 is the flange and the base. Branches, loops, jumps and calls of routines of the files are followed.
class KrlFrames {
 public:
  KrlFrames(const ProgramText& text, const ControllerData& controller);

  /// Takes the points that the program gives numbers; before complete().
  void take_points(const std::vector<Target>& targets);
  /// Completes a target that was read, by its name and place.
  void complete(Target& target);
  /// When all targets are completed: where routines end what is known of the arm, which loads hold for some motions
  /// alone, and once which calls of other files' routines were taken to leave tool and base as they are.
  void note_routines(Program& program) const;

 private:
  struct FrameNumbers {
    int tool = 0, base = 0;
    bool tool_on_robot = true;
    std::string unknown{};  ///< empty: the numbers are known
    bool operator==(const FrameNumbers&) const = default;
  };

  void read_data(std::size_t begin, std::size_t end);
  void read_line(std::size_t begin, std::size_t end);
  bool read_routine(const std::string& word, std::size_t begin, std::size_t next, std::size_t line_end);
  bool read_control(const std::string& word, std::size_t end, std::size_t next);
  void read_call(const std::string& word, std::size_t begin, std::size_t end, bool statement);
  void read_with(const std::string& word, std::size_t statement, std::size_t end, std::size_t at);
  void read_statement(std::size_t begin, std::size_t end);
  StatedFrames held(std::size_t begin, bool by_pose);
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
  std::set<std::pair<bool, int>> changed_;       ///< of tools or not, and by number: those that statements change
  std::map<std::string, FrameNumbers> data_of_;  ///< by the FDAT's name
  FrameFlow flow_{"$TOOL", "$BASE"};
  /// Bytes of motions for which alone a WITH sets tool or base.
  struct With {
    std::size_t begin, end;
    bool of_tool;
  };
  std::vector<With> with_;
  std::vector<PayloadStatement> loads_;       ///< those that a WITH sets for its motions
  std::string small_;                         ///< the code in small letters, once a load was read
  bool tool_beside_ = false;                  ///< $IPO_MODE may let it stand beside the robot
  bool root_moved_ = false;                   ///< the program has set $ROBROOT
  std::map<std::size_t, std::string> calls_;  ///< of routines, where they stand
  std::set<std::size_t> believed_;            ///< calls that targets' frames were believed through
  struct PointUse {
    std::string index;  ///< of its array; empty: none, or computed
    TargetUse use;
  };
  std::vector<TargetUse> uses_of(const std::string& stem, const std::string& index, const Target& target);

  std::map<std::string, std::vector<PointUse>> uses_;  ///< by the point's name without index
  GivenNumbers given_;
  std::set<std::string> any_element_;          ///< arrays of which an element is given numbers whose index is computed
  std::vector<std::size_t> never_moved_to_{};  ///< where points stand that no motion names
  std::vector<std::size_t> to_one_of_several_{};  ///< motions of which it is not told which numbers they go to
  std::map<std::size_t, Motion> motions_;         ///< where each begins
};

}  // namespace demecal::inline kuka_abb_ur
