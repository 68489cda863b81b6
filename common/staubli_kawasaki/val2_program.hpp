// VAL II: what the statements of programs say of the locations that they name, and the tool and base that they set.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/departures.hpp"
#include "staubli_kawasaki/location_frames.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {

/// Tool and base are those that hold at the motions to a point; of one that no motion names, one must serve all.
/// Motions whose location has an index that is computed are tied to none.
class Val2Statements {
 public:
  /// `text` must outlive this.
  explicit Val2Statements(const ProgramText& text) : text_(text), changes_(text) {}

  /// Takes a line of a program, [begin, end) of the code.
  void read_line(std::size_t begin, std::size_t end);

  /// Gives the program's targets their frames and motions, and those that it changes the reason to be left; the
  /// location that TOOL names is taken out, for nothing moves to it.
  void complete(Program& program, const ControllerData& controller);
  LocationFrames& way() { return way_; }

 private:
  void read_motion(const std::string& word, std::size_t statement, std::size_t begin, std::size_t end);
  void read_set(std::size_t begin, std::size_t end);
  void read_other(std::size_t statement, std::size_t word_end, std::size_t end);
  KnownFrame tool(const std::string& word, const Program& program, const ControllerData& controller);
  static KnownFrame base(const std::string& word, const ControllerData& controller);
  StatedFrames frames(const Program& program, const ControllerData& controller);
  StatedFrames frames_at(std::size_t motion, bool of_pose, StatedFrames held, const Program& program,
                         const ControllerData& controller);

  const ProgramText& text_;
  ChangedNames changes_;
  Departures departures_{};
  LocationFrames way_{};
  std::map<std::string, KnownFrame> known_tools_{};  ///< by what stands behind TOOL
  std::vector<std::string> tools_{},
      bases_{};  ///< what stands behind each instruction, without spaces, in small letters
  std::map<std::string, std::vector<TargetUse>> uses_{};
  struct Approach {
    std::size_t begin;
    std::string name;
    std::optional<double> distance_mm;
  };
  std::vector<Approach> approaches_{};
  std::vector<std::pair<std::size_t, std::string>> computed_{};  ///< destinations that are no locations
  std::string sets_configuration_{};                             ///< an instruction that does
  bool displaces_ = false;                                       ///< ALTER does
  UnknownStatements unknown_{};
};

}  // namespace demecal::inline staubli_kawasaki
