// The middle of many numbers.
#pragma once

#include <vector>

namespace demecal {

/// The upper one of the two middle values where there are as many below as above. There must be a value.
double median(std::vector<double> values);

}  // namespace demecal
