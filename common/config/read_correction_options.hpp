// What the `gp` map of a job says of joint corrections as such: their largest size, and formulas to begin with.
#pragma once

#include "calibration/job.hpp"
#include "config/yaml_node.hpp"

namespace demecal {

/// Reads `largest_correction_mrad`, `seed_formulas` (a text in rad for every joint, or {joint, expression}) and
/// `seed_models` (model files, whose corrections begin where they belong). Throws InputError at the first fault.
CorrectionOptions read_correction_options(const YamlNode& node);

}  // namespace demecal
