// SCENARIO.yaml: a simulated measurement, and the true errors of its robot.
#pragma once

#include <filesystem>

#include "simulation/scenario.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The scenario of a SCENARIO.yaml; its robot is named relative to it. Throws InputError with file, line, value and
/// rule at the first fault.
Scenario load_scenario(const std::filesystem::path& path);

/// Adds the errors of the map to the scenario, whose robot must be set. Throws InputError at the first fault.
void read_true_errors(const YamlNode& errors, Scenario& scenario);

}  // namespace demecal::inline config
