// Targets written as lists of numbers, in programs or in what they declare.
#pragma once

#include <span>

#include "programs/bracket_list.hpp"
#include "programs/program.hpp"

namespace demecal {

/// Whether a target's numbers must be numbers: those that declare it as data; elsewhere they may be expressions.
enum class Numbers { required, or_expressions };

/// The cells of the items, each with the unit beside it. Nothing, and a remark in `program`, where one is an expression
/// and may be one; throws InputError where one is neither.
std::optional<std::vector<Cell>> cells_of(const ProgramText& text, std::span<const BracketItem> items,
                                          std::span<const CellUnit> units, Numbers numbers, Program& program,
                                          const Target& target);

/// Says in `program` why this target cannot be corrected.
void leave(Program& program, const Target& target, const std::string& why);

/// Throws InputError at the place unless w, x, y, z are a unit quaternion, to the digits that files keep.
void require_quaternion(const ProgramText& text, std::span<const Cell> cells);

/// Throws InputError unless the arm has the six joints that this language's targets have.
void require_six_joints(const Chain& arm, const std::string& file, const std::string& language);

}  // namespace demecal
