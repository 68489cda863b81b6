// KUKA KRL: what statements do with the points that a program gives numbers, besides moving to them.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "parsed_programs/changed_names.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline kuka_abb_ur {

/// How many points a motion command begins with; 0 for words that are none.
std::size_t points_of_krl_motion(std::string_view word);

/// Behind the comma that ends the argument at `begin`, or past `end`.
std::size_t next_krl_argument(std::string_view code, std::size_t begin, std::size_t end);

/// The name of a point in small letters, and its index, "[3]"; no index where there is none or it is computed.
std::pair<std::string, std::string> krl_point_name(std::string_view name);

/// The names that the program declares as POS or E6POS, and as nothing else, in small letters.
std::set<std::string> krl_declared_poses(const ProgramText& text);

/// The numbers of a point are those that the robot is sent to where every statement that names it gives it numbers,
/// moves to it or copies it to another. Motions to anything else are said in the program.
class KrlStatements {
 public:
  /// `text` must outlive this.
  KrlStatements(const ProgramText& text, Program& program);

 private:
  /// A line of the code, and the name that is being read in it.
  struct Place {
    std::size_t line_begin, line_end;
    std::size_t begin, name_end;  ///< of the name, indices included
    std::size_t end;              ///< components included
  };

  void read_name(std::size_t begin, std::size_t end);
  void read_motion(std::size_t begin, std::size_t end);
  void read_destination(std::size_t motion, std::size_t begin, std::size_t line_end, bool last);
  void read_circle_angle(std::size_t begin, std::size_t line_end);
  void read_guidance(std::size_t begin, std::size_t end);
  void read_relative(std::size_t motion, std::size_t begin, std::size_t line_end);
  std::size_t after_index(std::size_t end, std::size_t line_end) const;
  bool is_declaration(const Place& place) const;
  /// Whether the aggregate at `begin` gives a point all its numbers.
  bool is_point(std::size_t begin) const;
  bool is_part_of_sum(std::size_t begin, std::size_t line_end);
  bool is_destination(const Place& place) const;
  bool is_copied(const Place& place) const;

  const ProgramText& text_;
  std::string_view code_;
  Program& program_;
  ChangedNames changes_;
  std::string displaces_{};         ///< what lets sensors displace motions
  bool keeps_orientation_ = false;  ///< $ORI_TYPE may let lines end with another orientation than their point's
  double moved_mm_ = 0.0;           ///< by relative motions since the last to a place; no number: unknown
  std::set<std::string> names_;     ///< of targets, in small letters
  std::set<std::size_t> numbers_;   ///< where those of targets begin
};

}  // namespace demecal::inline kuka_abb_ur
