// How the error fell over the rounds of the closed loop.
#pragma once

#include <optional>
#include <string>

#include "report/json_value.hpp"

namespace demecal {

/// The mean tool error (mm) on the validation poses after each round, from 0, as inline SVG: a step down where an
/// effect was added, a hollow mark where none was. `noise_mm`: the mean error that noise alone would make, drawn where
/// known. Empty where no round added anything or the errors are missing.
std::string loop_chart(const JsonValue& report, std::optional<double> noise_mm);

}  // namespace demecal
