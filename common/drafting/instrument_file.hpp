// What an instrument read, in the table that it, its program or a person wrote.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preparation/readings.hpp"

namespace demecal::inline drafting {

/// The readings of a table as read_table() recognises it, of columns as read_readings() has them or, where it has none
/// of these, by their headings. How it is written and what its headings do not say is told in `assumed`, a sentence
/// each. Throws InputError where it cannot be read.
Readings read_instrument_file(const std::filesystem::path& path, const std::optional<CordInstrument>& cords,
                              std::vector<std::string>& assumed);

}  // namespace demecal::inline drafting
