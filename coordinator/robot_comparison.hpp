// A robot's description beside poses read off its controller: what `robot show --compare` prints.
#pragma once

#include <string>

#include "data/data_set.hpp"

namespace demecal {

/// Prints how the description agrees with the poses of the file, in lines or as JSON; whether it does.
bool print_comparison(const std::string& poses_file, const Robot& robot, bool json);

}  // namespace demecal
