// Names that a program gives numbers more than once: which of them a motion goes to.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {

class GivenNumbers {
 public:
  /// Notes where the text branches, repeats, jumps or calls a routine of its own.
  explicit GivenNumbers(const ProgramText& text);

  /// The numbers at `begin` are given to this name.
  void give(const std::string& name, std::size_t begin) { given_[name].insert(begin); }

  /// The numbers of this name that the motion at `motion` goes to for sure: the last before it, where the program comes
  /// from these to the motion straight. Nothing where that is not told.
  std::optional<std::size_t> at(const std::string& name, std::size_t motion) const;

  /// Whether the motion may go to the numbers at `begin`.
  bool may_be(const std::string& name, std::size_t begin, std::size_t motion) const {
    return at(name, motion).value_or(begin) == begin;
  }

 private:
  void find_routines(const ProgramText& text);

  const ProgramSource& source_;
  std::set<std::string> routines_;  ///< in small letters
  std::vector<std::size_t> turns_;  ///< in the order of the text
  bool jumps_ = false;
  std::map<std::string, std::set<std::size_t>> given_;
};

}  // namespace demecal::inline parsed_programs
