// What a controller keeps outside of programs, and programs name only: frames and tools, and what a pulse is.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/chain.hpp"
#include "languages/program.hpp"
#include "languages/program_source.hpp"

namespace demecal::inline languages {

struct ControllerData {
  std::map<std::string, Eigen::Isometry3d> frames{};  ///< base from frame, by number or name in small letters
  std::map<std::string, Eigen::Isometry3d> tools{};   ///< flange from tool, likewise
  std::vector<double> pulses_per_deg{};               ///< of each joint (per mm where it slides); empty: unknown

  /// The frame of this key or, where it is not here, one that is unknown since it "is not given in this file". `name`
  /// is how people call it.
  KnownFrame frame(std::string_view key, const std::string& name) const;
  KnownFrame tool(std::string_view key, const std::string& name) const;
};

/// What a reader is given.
struct ReaderInput {
  const ProgramSource& source;
  const Chain& arm;
  const ControllerData& controller;
};

}  // namespace demecal::inline languages
