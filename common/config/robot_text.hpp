// A robot as YAML text, for files of its own and for files that hold one.
#pragma once

#include <string>

#include "data/data_set.hpp"

namespace demecal {

/// The keys of a ROBOT.yaml but its version, one or more lines each, every line moved `indent` spaces to the right.
/// robot_from() reads them back.
std::string robot_text(const Robot& robot, int indent = 0);

}  // namespace demecal
