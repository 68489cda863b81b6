// How readers of formulas say what they did not expect.
#pragma once

#include <string>
#include <string_view>

namespace demecal {

/// Throws the InputError that shows the beginning of `text`, names the column of its character `at` (from 0; shown from
/// 1), and says what was expected there.
[[noreturn]] void refuse_at(std::string_view text, std::size_t at, const std::string& expected);

}  // namespace demecal
