// Job files: what the user asks for.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "calibration/job.hpp"

namespace demecal {

struct YamlNode;

/// The job of a JOB.yaml; its data set is named relative to it and not opened. What the file leaves out keeps the Job's
/// defaults. Throws InputError with file, line, value and rule at the first fault.
Job load_job(const std::filesystem::path& path);
/// The same of a file already read.
Job read_job(const YamlNode& root);

/// The kinds of effects, by the words of reports.
std::span<const std::string> effect_kinds();

}  // namespace demecal
