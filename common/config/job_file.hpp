// Job files: what the user asks for.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "fitness/parameters.hpp"
#include "fitting/declared_model.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// The job of a JOB.yaml; its data set is named relative to it and not opened. What the file leaves out keeps the Job's
/// defaults. Throws InputError with file, line, value and rule at the first fault.
Job load_job(const std::filesystem::path& path);
/// The same of a file already read.
Job read_job(const YamlNode& root);

/// The kinds of effects, by the words of reports.
std::span<const std::string> effect_kinds();

/// The model that declares what `words` say, each of them one of declared_words().
DeclaredModel declared_model(std::span<const std::string> words);
/// The same of a list in a file. Throws InputError where a word is unknown or there twice.
DeclaredModel read_declared(const YamlNode& list);

/// The parameters of the map `gp`; those it leaves out keep their defaults. Throws InputError at the first fault, also
/// where together they break a rule of find_fault().
GpParameters read_gp(const YamlNode& node);

/// Reads from the same map `largest_correction_mrad`, `seed_formulas` (a text in rad for every joint, or {joint,
/// expression}) and `seed_models` (model files, whose corrections begin where they belong). Throws InputError at the
/// first fault.
CorrectionOptions read_correction_options(const YamlNode& node);

}  // namespace demecal::inline config
