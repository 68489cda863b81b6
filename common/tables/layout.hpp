// How a table is laid out in a text: what separates columns, which sign the decimals have, where headings and rows
// begin.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.hpp"

namespace demecal::inline tables {

enum class Delimiter { comma, semicolon, tab, blanks };

/// "comma", "semicolon", "tab", "blanks": as data sets name it.
std::string_view to_string(Delimiter delimiter);

/// What a user says of a table; the rest is recognised.
struct ToldLayout {
  std::optional<Delimiter> delimiter{};
  std::optional<char> decimal{};             ///< point or comma
  std::optional<std::size_t> header_line{};  ///< from 1; 0: no line has headings
};

/// Without blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// A line that is neither blank nor a comment.
struct TextLine {
  std::size_t number = 0;  ///< in the file, from 1
  std::string_view text;
  bool comment = false;
};

/// The lines of the text that are not blank, without line ends; of comments there are marks # % ! and //.
std::vector<TextLine> lines_of(std::string_view text);

/// The fields of a line, without quotes and surrounding blanks. A quote that does not embrace its field is a part of
/// it.
std::vector<std::string> fields_of(std::string_view line, Delimiter delimiter);

/// Whether the field is a number, with a point or with a comma, its thousands apart or not.
bool is_numeric(std::string_view field);

struct Layout {
  Delimiter delimiter = Delimiter::comma;
  std::size_t width = 0;      ///< fields of a row
  std::size_t first_row = 0;  ///< in the lines
};

/// The layout of the rows, nothing where no separator gives lines of several fields with numbers among them. Throws
/// InputError where two separators explain the lines as well.
std::optional<Layout> recognise_layout(const std::vector<TextLine>& lines, const ToldLayout& told,
                                       const std::string& file);

/// '.' or ',', by most numbers of the rows: those with the other sign are no numbers then. Throws InputError where both
/// are as many, and where every comma may as well separate thousands (1,234).
char decimal_sign(const std::vector<CsvRow>& rows, const std::string& file);

/// Whether the field is a number with its thousands apart and decimals behind: "1.542,66" or "1,542.66".
bool has_thousands_and_decimals(std::string_view field);

/// Takes the separators of thousands out of such numbers; whether there were any. `decimal`: the sign of the decimals.
bool take_thousands_together(std::vector<CsvRow>& rows, char decimal);

/// Throws InputError where rows of whole numbers between commas may be half as many numbers with decimal commas.
void refuse_split_decimals(const std::vector<CsvRow>& rows, const std::string& file);

/// Throws InputError where a heading stands for exactly two fields of every row: decimal commas between commas.
void refuse_half_headings(std::size_t headings, const CsvRow& row, const std::string& file);

}  // namespace demecal::inline tables
