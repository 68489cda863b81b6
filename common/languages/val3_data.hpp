// Staubli VAL3: the values that a data file (.dtx) declares, as tags with attributes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "languages/program_text.hpp"

namespace demecal::inline languages {

/// One <Value .../>, and what the <Data ...> around it says of it.
struct Val3Value {
  std::string name{};  ///< "pPick[2]": that of the data and its key
  std::string type{};  ///< of the data, as written
  std::size_t begin = 0;
  std::map<std::string, BracketItem> attributes{};  ///< where the text inside the quotes stands
};

/// All values of the file. Throws InputError where a tag or a quote is never closed.
std::vector<Val3Value> val3_values(const ProgramText& text);

}  // namespace demecal::inline languages
