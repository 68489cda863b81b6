// Staubli VAL3: the values that a data file (.dtx) declares, as tags with attributes, and where the code of programs
// (.pgx) stands.
#pragma once

#include <cstddef>
#include <map>
#include <set>
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

/// All values of the text. Throws InputError where a tag or a quote is never closed.
std::vector<Val3Value> val3_values(const ProgramText& text);

/// What stands between <Code> and </Code> of one program.
struct Val3Code {
  std::size_t begin = 0, end = 0;
  std::set<std::string> locals{};  ///< the names of its parameters and local variables
};

/// All programs of the text. Throws InputError as val3_values() does.
std::vector<Val3Code> val3_programs(const ProgramText& text);

}  // namespace demecal::inline languages
