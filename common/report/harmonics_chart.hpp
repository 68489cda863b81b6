// The gear harmonics of one joint: how large each is.
#pragma once

#include <string>
#include <vector>

#include "report/harmonics.hpp"

namespace demecal {

/// A stem per harmonic at its cycles per turn, as high as its amplitude (mrad or mm, up to `highest`, SI) with a
/// whisker of a standard error to either side, as inline SVG. Empty without harmonics.
std::string harmonics_chart(std::uint64_t joint, const std::vector<Harmonic>& harmonics, double highest);

}  // namespace demecal
