// Job files: what the user asks for.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

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

/// What may be declared, by the words of jobs.
std::vector<std::string> declared_words();
/// The model that declares what `words` say, each of them one of declared_words().
DeclaredModel declared_of(std::span<const std::string> words);

}  // namespace demecal
