// Model files: what a calibration found, for evaluate, apply and people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/evolver.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The text of a model.yaml: the robot, where the numbers came from, the identified numbers with standard errors, and
/// every joint's correction with its range, bound and jumps.
std::string model_text(const CalibratedModel& model);

/// The model of a model.yaml. Predictions need `robot` alone; estimates and notes are for people and not read back.
/// Throws InputError with file, line, value and rule at the first fault.
CalibratedModel load_model(const std::filesystem::path& path);
/// The same of its text; `path` is for messages.
CalibratedModel read_model(const std::string& text, const std::string& path);

/// The key `effects` with one item an effect: kind, joint (from 1), form, settings and coefficients by their names, a
/// symbolic effect's formula, standard errors, and the ranges it was measured in. read_effects() reads it back.
std::string effects_text(const std::vector<Effect>& effects, const Robot& robot);

/// The effects that `list`, the value of the key `effects`, holds for this robot, as effects_text() writes them. Throws
/// InputError at a kind outside the catalogue, an unknown key, a joint the robot has not, a missing coefficient or
/// setting.
std::vector<Effect> read_effects(const YamlNode& list, const Robot& robot);

/// The key `shared_functions`, where functions were looked for, be none found.
std::string functions_text(const CalibratedModel& model);

/// The key `corrections`, with one item a joint.
std::string corrections_text(const CalibratedModel& model);

/// The functions of the key's value; nothing where the file lacks it (null). Throws InputError.
KnownFunctions read_functions(const YamlNode* list);

/// Reads the key's value into a model whose chain and functions are already read. Throws InputError.
void read_corrections(const YamlNode& list, CalibratedModel& model);

/// The keys `measured_ranges`, `measured_gaps`, `pose_counts`, `pose_marks` and `posterior`, each as far as the model
/// has it.
std::string posterior_text(const CalibratedModel& model);

/// Reads the keys of a model file, where they are, into a model whose robot is already read. Throws InputError.
void read_posterior(const YamlNode& file, CalibratedModel& model);

/// The key `fleet`, where the model is the mean of several robots.
std::string fleet_text(const CalibratedModel& model);

/// Reads the key, where it is, into a model whose posterior is already read. Throws InputError.
void read_fleet(const YamlNode& file, CalibratedModel& model);

/// The key `prediction_interval`, where the model has it.
std::string prediction_text(const CalibratedModel& model);

/// Reads the key, where it is. Throws InputError.
void read_prediction(const YamlNode& file, CalibratedModel& model);

}  // namespace demecal::inline config
