// How far a model's predictions err, as its file states it.
#pragma once

#include <string>

#include "closed_calibration/calibrated_model.hpp"
#include "config/yaml_node.hpp"

namespace demecal {

/// The key `prediction_interval`, where the model has it.
std::string prediction_text(const CalibratedModel& model);

/// Reads the key, where it is. Throws InputError.
void read_prediction(const YamlNode& file, CalibratedModel& model);

}  // namespace demecal
