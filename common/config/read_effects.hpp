// The effects of a model file, read strictly.
#pragma once

#include <vector>

#include "config/yaml_node.hpp"
#include "effects/effect.hpp"

namespace demecal {

/// The effects that `list`, the value of the key `effects`, holds for this robot, as effects_text() writes them. Throws
/// InputError at a kind outside the catalogue, an unknown key, a joint the robot has not, a missing coefficient or
/// setting.
std::vector<Effect> read_effects(const YamlNode& list, const Robot& robot);

}  // namespace demecal
