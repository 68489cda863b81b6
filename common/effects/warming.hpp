// How much warmer than its reference a law takes the arm to be.
#pragma once

#include <string>

#include "effects/effect.hpp"
#include "effects/joint_words.hpp"

namespace demecal {

/// K above the setting reference_celsius; 0 where either is unknown.
inline double warming_kelvin(const Effect& effect, const Stop& stop) {
  const auto reference = effect.settings.find("reference_celsius");
  if (!stop.temperature_celsius || reference == effect.settings.end()) return 0.0;
  return *stop.temperature_celsius - reference->second;
}

/// "(T - 20 degC)".
inline std::string warming_symbol(const Effect& effect) {
  return "(T - " + number_words(effect.setting("reference_celsius")) + " degC)";
}

}  // namespace demecal
