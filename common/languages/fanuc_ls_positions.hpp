// FANUC .LS: what stands in a position of /POS, part by part.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// What stands behind a name in a position: a number and its unit, or a word.
struct FanucPart {
  BracketItem value;
  std::string unit{};
};
/// By names in small letters.
using FanucParts = std::map<std::string, FanucPart>;

/// The parts of the first group of motion in a position, [begin, end) between its braces; all of them where it names no
/// group. Nothing where it names other groups only.
std::optional<FanucParts> fanuc_position_parts(const ProgramText& text, std::size_t begin, std::size_t end);

/// ArmHint::turns of CONFIG's words, without blanks: "NUT,0,0,1" states turns of joints 1, 4 and 6. Empty where three
/// numbers do not stand there.
std::vector<std::optional<int>> fanuc_turns(std::string_view configuration);

/// Program::joint_counting: FANUC's pendants and programs count joint 3 against the ground. Empty where no target
/// states joints, or the arm states such a coupling.
std::string fanuc_joint_counting(const std::vector<Target>& targets, const Chain& arm);

}  // namespace demecal::inline languages
