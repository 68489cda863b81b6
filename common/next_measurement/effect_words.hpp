// Effects in words, for sentences and names that people read.
#pragma once

#include <string>
#include <vector>

namespace demecal::inline next_measurement {

/// What tells effects of unknown masses apart, by the names of their settings: "of links 2 to 7", "of link 6 along x,
/// by a mount that leans one way" (for "gravity_turn_1"); empty where the names say nothing of masses.
std::string masses_words(const std::vector<std::string>& settings);

}  // namespace demecal::inline next_measurement
