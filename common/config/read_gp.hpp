// The `gp` map of a job: the thesis's parameters by their names in lower case.
#pragma once

#include "config/yaml_node.hpp"
#include "evolution/parameters.hpp"

namespace demecal {

/// The parameters of the map; those it leaves out keep their defaults. Throws InputError at the first fault, also where
/// together they break a rule of find_fault().
GpParameters read_gp(const YamlNode& node);

}  // namespace demecal
