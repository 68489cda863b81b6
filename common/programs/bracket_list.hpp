// Lists in brackets, such as [[1, 2], x]: what stands between the commas, and where.
#pragma once

#include "programs/program_text.hpp"

namespace demecal {

struct BracketItem {
  std::size_t begin = 0, size = 0;  ///< without the white space around; of a list, its brackets included
  bool is_list = false;
  std::vector<BracketItem> items{};  ///< of a list
};

/// The list that opens at `begin` with `opening`, '[' or '{'. Commas inside parentheses separate nothing. Throws
/// InputError where it is never closed, or is nested more than 20 deep.
BracketItem read_list(const ProgramText& text, std::size_t begin, char opening);

}  // namespace demecal
