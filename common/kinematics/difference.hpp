// In what two arms differ as their makers describe them.
#pragma once

#include <string>

#include "kinematics/chain.hpp"

namespace demecal::inline kinematics {

/// The first difference of `other` from `one`, said of `other`: "its joint 3 has d 120 mm, not 100 mm"; empty where
/// there is none. Tools and limits may differ, and numbers by what rounding leaves (1e-9 m or rad).
std::string first_difference(const Chain& one, const Chain& other);

}  // namespace demecal::inline kinematics
