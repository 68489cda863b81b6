// The figures that users judge by, of errors already known.
#pragma once

#include <vector>

#include "effects/measurement.hpp"

namespace demecal {

/// As error_figures() of poses, of these tool errors, mm (none NaN); all NaN where there are none.
ErrorFigures error_figures(std::vector<double> errors_mm);

}  // namespace demecal
