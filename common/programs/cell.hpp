// A number in a program's text: what it means, and how another is written in its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace demecal {

/// Decimals that keep 0.001 mm and 0.0001 degrees; fewer are never written, unless the file counts in whole steps.
inline constexpr int kDecimalsMm = 3, kDecimalsM = 6, kDecimalsDeg = 4, kDecimalsRad = 6, kDecimalsQuaternion = 7;

struct Cell {
  std::size_t begin = 0, size = 0;  ///< its bytes
  double value = 0.0;               ///< as written, in the file's own unit
  double unit = 1.0;                ///< the file's unit in SI units or rad
  int decimals = 0;                 ///< that another number is written with here

  double inside() const { return value * unit; }
};

/// The unit a cell is in, and the fewest decimals it is written with.
struct CellUnit {
  double size = 1.0;
  int least_decimals = 0;
};

/// The number that stands at [begin, begin + size) of `text`; it keeps its own decimals where these are more. Nothing
/// where no finite number stands there.
std::optional<Cell> cell_at(std::string_view text, std::size_t begin, std::size_t size, const CellUnit& unit);

/// The text that `inside` (SI or rad) has in the cell. Nothing where, with the cell's decimals, it is what stands
/// there: then its bytes stay.
std::optional<std::string> rewritten(const Cell& cell, double inside);

}  // namespace demecal
