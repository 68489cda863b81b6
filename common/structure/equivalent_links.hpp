// The same arm with nothing between its links: what a structure found means in the numbers of Denavit and Hartenberg.
#pragma once

#include "structure/structured_arm.hpp"

namespace demecal {

/// A robot without transforms between its links that predicts what `arm` does, everywhere, to rounding. Every transform
/// goes into the link before it: the next axis is a line, and four numbers lead to any line (Denavit and Hartenberg,
/// 1955; Hayati's beta in place of d between axes that are nominally parallel); what turns about and shifts along that
/// line goes on to the next joint, and what is left at the flange to the tools. The base stays.
CorrectedRobot equivalent_robot(const StructuredArm& arm);

}  // namespace demecal
