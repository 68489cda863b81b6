// The effects of a model as YAML text.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.hpp"

namespace demecal {

/// The key `effects` with one item an effect: kind, joint (from 1), form, settings and coefficients by their names, a
/// symbolic effect's formula, standard errors, and the ranges it was measured in. read_effects() reads it back.
std::string effects_text(const std::vector<Effect>& effects, const Robot& robot);

}  // namespace demecal
