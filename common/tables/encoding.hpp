// Text as other programs encode it, made UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace demecal::inline tables {

struct DecodedText {
  std::string text;      ///< UTF-8, without a byte order mark
  std::string encoding;  ///< for people: "UTF-16"; empty where it was UTF-8
};

/// UTF-8 and UTF-16 with or without a byte order mark, by what the bytes show; bytes that are neither are taken for
/// Latin-1. Throws InputError where the bytes are no text, naming what they are where that can be told (a spreadsheet,
/// a PDF), or where UTF-16 is broken off.
DecodedText decode_text(std::string_view bytes, const std::string& file);

}  // namespace demecal::inline tables
