// Tables as instruments and loggers write them.
#pragma once

#include <string>
#include <string_view>

#include "data/csv.hpp"
#include "tables/layout.hpp"

namespace demecal::inline tables {

struct RecognisedTable {
  CsvTable table;
  /// How it is written, for people: "semicolons between columns, decimal comma, ..."; empty for plain CSV as
  /// demecal writes it.
  std::string found;
};

/// The table in the bytes of a file: separated by commas, semicolons, tabs or blanks, decimals with point or comma,
/// after lines that are no part of it, with or without headings and units, in UTF-8, UTF-16 or Latin-1. Blank lines and
/// those that begin with # % ! or // are skipped; headings may stand in the last such line. Without headings columns
/// have their numbers for names. Throws InputError with the first line that does not fit, and where bytes can be
/// understood in two ways, with the key that resolves it.
RecognisedTable read_table(std::string_view bytes, const std::string& file, const ToldLayout& told = {});

}  // namespace demecal::inline tables
