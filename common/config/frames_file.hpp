// FRAMES.yaml: the frames and tools that a controller keeps by number or name, and programs only name.
#pragma once

#include <filesystem>

#include "languages/controller_data.hpp"

namespace demecal::inline config {

/// The frames and tools of the file. Throws InputError with file, line, value and rule at the first fault.
ControllerData load_frames(const std::filesystem::path& path);

}  // namespace demecal::inline config
