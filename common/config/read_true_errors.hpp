// The `errors` map of a scenario: what is wrong with the simulated robot and its instrument.
#pragma once

#include "config/yaml_node.hpp"
#include "simulation/scenario.hpp"

namespace demecal {

/// Adds the errors of the map to the scenario, whose robot must be set. Throws InputError at the first fault.
void read_true_errors(const YamlNode& errors, Scenario& scenario);

}  // namespace demecal
