// The rows of a family of robot languages: KRL, RAPID and URScript.
#pragma once

#include <vector>

#include "parsed_programs/language.hpp"

namespace demecal::inline kuka_abb_ur {

/// In the order in which programs are searched for their signs.
std::vector<Language> kuka_abb_ur_languages();

}  // namespace demecal::inline kuka_abb_ur
