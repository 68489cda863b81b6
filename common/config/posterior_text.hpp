// How sure a model's numbers are, as its file states it: their covariance, and each joint's measured range.
#pragma once

#include <string>

#include "closed_calibration/calibrated_model.hpp"
#include "config/yaml_node.hpp"

namespace demecal {

/// The keys `measured_ranges` and `posterior`, each as far as the model has it.
std::string posterior_text(const CalibratedModel& model);

/// Reads the keys of a model file, where they are, into a model whose robot is already read. Throws InputError.
void read_posterior(const YamlNode& file, CalibratedModel& model);

}  // namespace demecal
