// Numbers as text, the same in every locale: read strictly, written with as many digits as they need.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace demecal {

/// The finite number that the whole of `text` writes in decimal notation, a leading + allowed. Nothing where it writes
/// no number, one out of range, NaN or an infinity.
std::optional<double> parse_number(std::string_view text);

/// The shortest text that parses back to the same bits.
std::string number_text(double value);

/// A change of unit, such as radians() or metres().
using UnitConversion = double (*)(double);

/// The shortest decimal of `inside` in the border's unit that `to_inside` turns back into the same bits; where no
/// decimal does, the one that comes within the last bit.
std::string number_text(double inside, UnitConversion to_border, UnitConversion to_inside);

}  // namespace demecal
