// Preparation files: where raw measurements, programs and taught points stand, and what the instrument is.
#pragma once

#include <filesystem>
#include <optional>

#include "preparation/prepared.hpp"
#include "preparation/readings.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// Everything that a PREPARATION.yaml names, read; the files are taken relative to it. Throws InputError with file,
/// line, value and rule at the first fault in any of them.
RawMeasurements load_preparation(const std::filesystem::path& path);

/// What stands under `instrument`: three cords, or nothing where it is the word `points`, an instrument that reads
/// coordinates.
std::optional<CordInstrument> read_instrument(const YamlNode& node);

}  // namespace demecal::inline config
