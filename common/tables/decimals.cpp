#include "data/csv.hpp"
#include "tables/layout.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline tables {
namespace {

bool is_digits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The digits before and after the one sign of the number, without its own sign and exponent.
struct Decimals {
  std::string_view before, after;
};
std::optional<Decimals> digits_about(std::string_view field, char sign) {
  if (!field.empty() && (field.front() == '+' || field.front() == '-')) field.remove_prefix(1);
  const std::size_t at = field.find(sign);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view after = field.substr(at + 1);
  const std::size_t exponent = after.find_first_of("eE");
  if (exponent != std::string_view::npos) after = after.substr(0, exponent);
  const std::string_view before = field.substr(0, at);
  if (!is_digits(before) || !is_digits(after) || (before.empty() && after.empty())) return std::nullopt;
  return Decimals{before, after};
}

/// Whether the comma may separate thousands.
bool may_group(const Decimals& number) {
  return number.after.size() == 3 && !number.before.empty() && number.before.size() <= 3 &&
         number.before.front() != '0';
}

/// The sign before the decimals of a number whose thousands stand apart by the other one, "1.542,66" or "1,542.66";
/// nothing of any other field.
std::optional<char> sign_behind_thousands(std::string_view field) {
  if (!field.empty() && (field.front() == '+' || field.front() == '-')) field.remove_prefix(1);
  const std::size_t last = field.find_last_of(".,"), first = field.find_first_of(".,");
  if (last == first) return std::nullopt;
  const char sign = field[last], apart = sign == ',' ? '.' : ',';
  const std::string_view whole = field.substr(0, last), decimals = field.substr(last + 1);
  if (first == 0 || first > 3 || field.front() == '0' || decimals.empty() || !is_digits(decimals) ||
      !is_digits(whole.substr(0, first)))
    return std::nullopt;
  for (std::string_view rest = whole.substr(first); !rest.empty(); rest.remove_prefix(4))
    if (rest.size() < 4 || rest.front() != apart || !is_digits(rest.substr(1, 3))) return std::nullopt;
  return sign;
}

struct NumberPlace {
  std::size_t line = 0;
  std::string field;
};

[[noreturn]] void fail_mixed(const NumberPlace& comma, const NumberPlace& point, const std::string& file) {
  const NumberPlace& later = comma.line > point.line ? comma : point;
  const NumberPlace& earlier = comma.line > point.line ? point : comma;
  throw InputError({file, later.line}, later.field,
                   "and '" + earlier.field + "' in line " + std::to_string(earlier.line) +
                       " have different decimal signs: export the numbers alike, or say which sign is meant by "
                       "`decimal: point` or `decimal: comma` beside the file's name");
}

}  // namespace

bool has_thousands_and_decimals(std::string_view field) {
  return sign_behind_thousands(field).has_value();
}

bool take_thousands_together(std::vector<CsvRow>& rows, char decimal) {
  bool any = false;
  for (CsvRow& row : rows) {
    for (std::string& field : row.fields) {
      if (sign_behind_thousands(field) != decimal) continue;
      std::erase(field, decimal == ',' ? '.' : ',');
      any = true;
    }
  }
  return any;
}

char decimal_sign(const std::vector<CsvRow>& rows, const std::string& file) {
  std::optional<NumberPlace> comma, point;
  std::size_t commas = 0, points = 0;
  bool surely = false;
  for (const CsvRow& row : rows) {
    for (const std::string& field : row.fields) {
      const std::optional<char> told = sign_behind_thousands(field);
      const auto number = digits_about(field, ',');
      if (number || told == ',') {
        ++commas;
        if (!comma) comma = NumberPlace{row.line, field};
        surely = surely || !number || !may_group(*number);
      } else if (digits_about(field, '.') || told == '.') {
        ++points;
        if (!point) point = NumberPlace{row.line, field};
      }
    }
  }
  if (commas < points || commas == 0) return '.';
  if (points > 0 && (commas == points || !surely)) fail_mixed(*comma, *point, file);
  if (surely) return ',';
  throw InputError(
      {file, comma->line}, comma->field,
      "may be a number with three decimals or one with its thousands apart, as may all others of the file: "
      "say `decimal: comma` beside the file's name, or export without separators of thousands");
}

void refuse_split_decimals(const std::vector<CsvRow>& rows, const std::string& file) {
  if (rows.empty() || rows.front().fields.size() % 2 != 0 || rows.front().fields.size() < 4) return;
  for (const CsvRow& row : rows) {
    for (std::size_t i = 0; i < row.fields.size(); ++i) {
      std::string_view field = row.fields[i];
      if (i % 2 == 0 && (field.starts_with('-') || field.starts_with('+'))) field.remove_prefix(1);
      if (field.empty() || !is_digits(field)) return;
    }
  }
  throw InputError({file, rows.front().line}, "",
                   "the rows have " + std::to_string(rows.front().fields.size()) +
                       " whole numbers between commas, or " + std::to_string(rows.front().fields.size() / 2) +
                       " numbers with decimal commas: say `decimal: point` beside the file's name if they are whole, "
                       "else export with semicolons or tabs between columns");
}

void refuse_half_headings(std::size_t headings, const CsvRow& row, const std::string& file) {
  if (headings < 2 || row.fields.size() != 2 * headings) return;
  throw InputError(
      {file, row.line}, "",
      "the row has twice as many fields as there are headings: commas stand for decimals as well as between "
      "columns, which cannot be told apart. Export with semicolons or tabs between columns, or with "
      "decimal points");
}

}  // namespace demecal::inline tables
