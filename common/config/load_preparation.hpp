// Preparation files: where raw measurements, programs and taught points stand, and what the instrument is.
#pragma once

#include <filesystem>

#include "preparation/prepared.hpp"

namespace demecal {

/// Everything that a PREPARATION.yaml names, read; the files are taken relative to it. Throws InputError with file,
/// line, value and rule at the first fault in any of them.
RawMeasurements load_preparation(const std::filesystem::path& path);

}  // namespace demecal
