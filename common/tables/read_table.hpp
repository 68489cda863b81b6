// Tables as instruments and loggers write them: text as other programs encode it, made UTF-8, and its rows and columns.
#pragma once

#include <string>
#include <string_view>

#include "data/csv.hpp"
#include "tables/layout.hpp"

namespace demecal::inline tables {

struct DecodedText {
  std::string text;      ///< UTF-8, without a byte order mark
  std::string encoding;  ///< for people: "UTF-16"; empty where it was UTF-8
};

/// UTF-8 and UTF-16 with or without a byte order mark, by what the bytes show; bytes that are neither are taken for
/// Latin-1. Throws InputError where the bytes are no text, naming what they are where that can be told (a spreadsheet,
/// a PDF), or where UTF-16 is broken off.
DecodedText decode_text(std::string_view bytes, const std::string& file);

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
