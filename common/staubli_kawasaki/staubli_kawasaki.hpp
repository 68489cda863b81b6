// The rows of a family of robot languages: VAL II, VAL3 and AS.
#pragma once

#include <vector>

#include "parsed_programs/language.hpp"

namespace demecal::inline staubli_kawasaki {

/// In the order in which programs are searched for their signs.
std::vector<Language> staubli_kawasaki_languages();

}  // namespace demecal::inline staubli_kawasaki
