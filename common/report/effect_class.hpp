// The class of effects that these poses cannot tell apart, as it is named to people.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/outcome.hpp"

namespace demecal {

/// The round's effect and its rivals at a cosine above 0.98, one of a kind and joint, the most common cause first;
/// empty where the effect has no such rival.
std::vector<Effect> effect_class(const Round& round);

/// "link geometry of joints 2 and 3 or instrument scale", "backlash or friction hysteresis of joint 2".
std::string class_words(const std::vector<Effect>& members);

/// "Link geometry of joint 2 or instrument scale: these poses cannot tell."; empty for an empty class.
std::string class_sentence(const std::vector<Effect>& members);

}  // namespace demecal
