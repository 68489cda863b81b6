// Figures in few letters, as they stand in the cells of a table.
#pragma once

#include <cstdint>
#include <string>

namespace demecal {

/// At most 7 letters with 2 digits or more: "0.01234", "1.2e-05", "inf"; a dash for what is not a number.
std::string short_real(double value);
/// At most 5 letters: "812", "12.3k", "4.56M".
std::string short_count(double value);
/// "87%"; a share of 0 to 1.
std::string percent(double share);
/// "8 s", "3 min 20 s", "2 h 5 min".
std::string short_time(double time_s);
/// A bar of `columns` letters, of which the share is full: "━━━" and "───".
struct BarParts {
  std::string full, empty;
};
BarParts bar_parts(double share, std::size_t columns);

}  // namespace demecal
