// The bar chart of the tool error from stage to stage.
#pragma once

#include <optional>
#include <string>

#include "report/error_stages.hpp"

namespace demecal {

/// One group of bars per stage and one bar per shown set, from 0 to the mean with a line to P95, mm, as inline SVG.
/// The nominal robot's bars are cut off where they would dwarf all others. `noise_mm`: the mean error that the noise
/// of the measurement alone would make, drawn where known. Empty where there is nothing to draw.
std::string stage_chart(const ErrorStages& errors, std::optional<double> noise_mm);

}  // namespace demecal
