// What formulas of the joints alone cannot say of an effect.
#pragma once

#include <string>

#include "effects/effect.hpp"

namespace demecal {

/// A sentence on an effect that depends on more than the joints, as formulas hold it or (not `held`) leave it out;
/// empty where they hold the whole of it.
std::string note_on(const Effect& effect, const Robot& robot, bool held);

}  // namespace demecal
