// The instrument of a preparation file.
#pragma once

#include <optional>

#include "config/yaml_node.hpp"
#include "preparation/readings.hpp"

namespace demecal {

/// What stands under `instrument`: three cords, or nothing where it is the word `points`, an instrument that reads
/// coordinates.
std::optional<CordInstrument> read_instrument(const YamlNode& node);

}  // namespace demecal
