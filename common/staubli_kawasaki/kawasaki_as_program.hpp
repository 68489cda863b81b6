// Kawasaki AS: what the statements of programs say of the locations that they name, and the frames that they set.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/departures.hpp"
#include "staubli_kawasaki/location_frames.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {

/// A location that a statement writes as numbers: TRANS(x, y, z, o, a, t) or #PPOINT(jt1, ...).
struct LocationLiteral {
  std::string name{};  ///< that POINT gives it; empty: none
  BracketItem list{};
  std::size_t begin = 0;
  bool of_joints = false;
  std::optional<TargetUse> use{};  ///< of the motion that holds it
};

class AsStatements {
 public:
  /// `text` must outlive this.
  explicit AsStatements(const ProgramText& text) : changes_(text) {}

  /// Takes a line of a program, [begin, end) of the code.
  void read_line(const ProgramText& text, std::size_t begin, std::size_t end);
  /// Takes a line of .SYSDATA: "BASE" and "TOOL" with six numbers.
  void read_system_line(const ProgramText& text, std::size_t begin, std::size_t end);

  const std::vector<LocationLiteral>& literals() const { return literals_; }
  /// Where motions go to what is computed, and what that is.
  const std::vector<std::pair<std::size_t, std::string>>& computed() const { return computed_; }
  /// The steps of block format, and their joints as written.
  const std::vector<std::pair<std::size_t, std::string>>& block_steps() const { return block_steps_; }
  /// Where TILL may stop a motion on its way.
  const std::vector<std::size_t>& stopped() const { return stopped_; }
  /// Says where motions come near a location only, and how near.
  void note_approaches(const ProgramText& text, Program& program) const;
  /// Why the location of this key (location_key) is not what the arm is sent to; empty: it is.
  std::string not_sent_to(const std::string& name) const;
  /// Why poses are not reached in a configuration that can be told; empty: nothing sets one.
  const std::string& sets_configuration() const { return sets_configuration_; }
  /// Whether motions may be altered while they run (ALTER).
  bool displaces() const { return displaces_; }
  const UnknownStatements& unknown() const { return unknown_; }
  /// Whether TOOL or BASE names this location, so that nothing moves to it.
  bool is_frame(const std::string& name) const { return tools_.contains(name) || bases_.contains(name); }

  /// What locations that TOOL and BASE name are; `base` is also asked for "base", what the controller keeps.
  struct Lookup {
    std::function<std::optional<Eigen::Isometry3d>(const std::string&)> tool, base;
  };
  /// The frames of a location that no motion names: those that serve all of them.
  StatedFrames frames(const Lookup& lookup) const;
  /// The frames of a motion.
  StatedFrames frames_at(std::size_t motion, bool of_pose, const Lookup& lookup);
  LocationFrames& way() { return way_; }
  /// When the way is finished: takes the motions that leave a location.
  void take_departures(const ProgramText& text, Program& program) {
    departures_.take(text, way_.flow(), uses_, program);
  }
  /// The motions to every location, by its key.
  const std::map<std::string, std::vector<TargetUse>>& uses() const { return uses_; }
  /// The motions to a location of this key.
  std::vector<TargetUse> uses(const std::string& name) const;

 private:
  /// Whether the tool is another than the one that all block steps, if there are any, select.
  bool sets_tool() const;
  KnownFrame tool_of(const std::string& word, const Lookup& lookup) const;
  KnownFrame base_of(const std::string& word, const Lookup& lookup) const;
  struct Approach {
    std::size_t begin;
    std::string name;
    std::optional<double> distance_mm;
  };

  /// Locations that [begin, end) hands on or computes with.
  void use_all(const ProgramText& text, std::size_t begin, std::size_t end);
  void read_motion(const ProgramText& text, const std::string& word, std::size_t begin, std::size_t end);
  void read_block_step(const ProgramText& text, std::size_t begin, std::size_t joints, std::size_t end);
  void read_point(const ProgramText& text, std::size_t begin, std::size_t end);
  std::optional<LocationLiteral> literal_at(const ProgramText& text, std::size_t begin, std::size_t end) const;

  ChangedNames changes_;
  Departures departures_;
  std::vector<Approach> approaches_{};
  std::vector<LocationLiteral> literals_;
  std::vector<std::pair<std::size_t, std::string>> computed_, block_steps_;
  std::vector<std::size_t> stopped_;
  std::map<std::string, std::vector<TargetUse>> uses_;
  std::map<std::string, std::string> not_sent_to_;
  std::set<std::string> tools_;
  std::set<std::string> bases_;
  bool system_base_ = false;  ///< .SYSDATA moves the base
  LocationFrames way_;
  std::string sets_configuration_{};
  bool displaces_ = false;
  UnknownStatements unknown_{};
};

}  // namespace demecal::inline staubli_kawasaki
