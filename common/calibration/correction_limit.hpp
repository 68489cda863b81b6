// How large a joint's correction may become anywhere within its range.
#pragma once

#include "calibration/training.hpp"

namespace demecal {

/// Three times the size of target errors that one row in twenty exceeds, but at most `largest_rad` of the training.
/// Over rows of full weight; in tables of squared errors, over those that count no less than the median one.
double correction_limit_rad(const JointTraining& training);

/// Sets the limit of the training's table, from which islands know what to refuse.
void limit_formulas(JointTraining& training);

}  // namespace demecal
