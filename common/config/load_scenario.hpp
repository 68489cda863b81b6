// Scenario files: a simulated measurement.
#pragma once

#include <filesystem>

#include "simulation/scenario.hpp"

namespace demecal {

/// The scenario of a SCENARIO.yaml; its robot is named relative to it. Throws InputError with file, line, value and
/// rule at the first fault.
Scenario load_scenario(const std::filesystem::path& path);

}  // namespace demecal
