// Names that a program gives numbers more than once: which of them a motion goes to.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "parsed_programs/frame_flow.hpp"

namespace demecal::inline parsed_programs {

class GivenNumbers {
 public:
  /// The numbers at `begin` are given to this name.
  void give(const std::string& name, std::size_t begin) { given_[name].insert(begin); }

  /// The numbers of this name that the motion at `motion` goes to for sure: the only ones or, where the way through the
  /// program leads from the last before it to the motion and nowhere else, these. Nothing where that is not told.
  std::optional<std::size_t> at(const std::string& name, std::size_t motion, const FrameFlow& way) const;

  /// Whether the motion may go to the numbers at `begin`.
  bool may_be(const std::string& name, std::size_t begin, std::size_t motion, const FrameFlow& way) const {
    return at(name, motion, way).value_or(begin) == begin;
  }

 private:
  std::map<std::string, std::set<std::size_t>> given_;
};

}  // namespace demecal::inline parsed_programs
