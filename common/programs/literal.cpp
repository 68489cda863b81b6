#include "programs/literal.hpp"

#include <cmath>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal {

void leave(Program& program, const Target& target, const std::string& why) {
  program.left.push_back({target.place, target.name, why + "; it is left as it is"});
}

std::optional<std::vector<Cell>> cells_of(const ProgramText& text, std::span<const BracketItem> items,
                                          std::span<const CellUnit> units, Numbers numbers, Program& program,
                                          const Target& target) {
  DEMECAL_CHECK(items.size() == units.size(), items.size() << " items, " << units.size() << " units");
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string_view word = text.code().substr(items[i].begin, items[i].size);
    if (numbers == Numbers::or_expressions && is_expression(word)) {
      leave(program, target, "'" + std::string(word) + "' is no number");
      return std::nullopt;
    }
    cells.push_back(text.number(items[i].begin, items[i].size, units[i]));
  }
  return cells;
}

void require_quaternion(const ProgramText& text, std::span<const Cell> cells) {
  constexpr double kRounding = 0.01;
  double square = 0.0;
  for (const Cell& cell : cells) square += cell.value * cell.value;
  if (std::abs(std::sqrt(square) - 1.0) < kRounding) return;
  const Cell &first = cells.front(), &last = cells.back();
  text.fail(first.begin, last.begin + last.size - first.begin, "must be a unit quaternion");
}

void require_six_joints(const Chain& arm, const std::string& file, const std::string& language) {
  if (arm.size() == 6) return;
  throw InputError(
      {file, 0}, "",
      "is a program in " + language + ", whose arms have 6 joints; the model's has " + std::to_string(arm.size()));
}

}  // namespace demecal
