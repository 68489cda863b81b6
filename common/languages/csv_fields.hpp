// The fields of a row of a table.
#pragma once

#include <cstddef>
#include <vector>

#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {

/// The bytes of a field, without quotes and the spaces around it.
struct CsvField {
  std::size_t begin, size;
};

/// Those of [begin, end). Throws InputError where a quote is not closed, or text follows one.
std::vector<CsvField> csv_fields(const ProgramText& text, std::size_t begin, std::size_t end, char separator);

}  // namespace demecal::inline languages
