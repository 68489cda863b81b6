#include "tables/time_stamp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline tables {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes a text apart from its front.
class StampReader {
 public:
  explicit StampReader(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }
  bool take(char expected) {
    if (rest_.empty() || rest_.front() != expected) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// Whatever its letters' case.
  bool take_word(std::string_view word) {
    if (lower_case(std::string(rest_.substr(0, word.size()))) != word) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  bool take_one_of(std::string_view expected) {
    return std::ranges::any_of(expected, [&](char c) { return take(c); });
  }
  /// The whole number of `least` to `most` digits.
  std::optional<int> digits(std::size_t least, std::size_t most) {
    std::size_t count = 0;
    while (count < rest_.size() && count < most && is_digit(rest_[count])) ++count;
    if (count < least || (count < rest_.size() && is_digit(rest_[count]))) return std::nullopt;
    int value = 0;
    for (const char c : rest_.substr(0, count)) value = 10 * value + (c - '0');
    rest_.remove_prefix(count);
    return value;
  }
  /// Digits after a point or comma, as a share of one.
  std::optional<double> fraction() {
    const std::size_t count = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    const auto value = parse_number("0." + std::string(rest_.substr(0, count)));
    if (count == 0 || !value) return std::nullopt;
    rest_.remove_prefix(count);
    return value;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

bool is_leap(int year) {
  return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

/// Since the first day of 1970; nothing where there is no such day.
std::optional<double> day_s(int year, int month, int day) {
  constexpr int kDaysBefore1970 = 719162;  ///< from the first day of the year 1
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (year < 1 || month < 1 || month > 12) return std::nullopt;
  const auto days_in = [&](int one) { return kDays[static_cast<std::size_t>(one - 1)] + (one == 2 && is_leap(year)); };
  if (day < 1 || day > days_in(month)) return std::nullopt;
  const int before = year - 1;
  int days = 365 * before + before / 4 - before / 100 + before / 400 + day - 1 - kDaysBefore1970;
  for (int one = 1; one < month; ++one) days += days_in(one);
  return kDay_s * days;
}

/// "2026-11-24", "2026/11/24" or "24.11.2026", and the T or blank before a time.
std::optional<double> take_date(StampReader& reader) {
  const std::string_view text = reader.rest();
  const bool year_first = text.size() > 4 && (text[4] == '-' || text[4] == '/');
  const char separator = year_first ? text[4] : '.';
  const auto first = year_first ? reader.digits(4, 4) : reader.digits(1, 2);
  if (!first || !reader.take(separator)) return std::nullopt;
  const auto month = reader.digits(1, 2);
  if (!month || !reader.take(separator)) return std::nullopt;
  const auto last = year_first ? reader.digits(1, 2) : reader.digits(4, 4);
  if (!last || !reader.take_one_of("T t")) return std::nullopt;
  return year_first ? day_s(*first, *month, *last) : day_s(*last, *month, *first);
}

/// "19:39:57.25" or "7:39:57.25 PM".
std::optional<double> take_clock(StampReader& reader) {
  const auto hour = reader.digits(1, 2);
  if (!hour || *hour > 23 || !reader.take(':')) return std::nullopt;
  const auto minute = reader.digits(2, 2);
  if (!minute || *minute > 59 || !reader.take(':')) return std::nullopt;
  const auto second = reader.digits(2, 2);
  if (!second || *second > 60) return std::nullopt;
  double seconds = 3600.0 * *hour + 60.0 * *minute + *second;
  if (reader.take_one_of(".,")) {
    const auto fraction = reader.fraction();
    if (!fraction) return std::nullopt;
    seconds += *fraction;
  }
  reader.take(' ');
  const bool morning = reader.take_word("am");
  if (!morning && !reader.take_word("pm")) return seconds;
  if (*hour < 1 || *hour > 12) return std::nullopt;
  return seconds + 3600.0 * ((morning ? 0 : 12) - (*hour == 12 ? 12 : 0));
}

/// "Z" or "+01:00": what to subtract.
std::optional<double> take_zone(StampReader& reader) {
  if (reader.take_one_of("Zz")) return 0.0;
  const double sign = reader.take('+') ? 1.0 : reader.take('-') ? -1.0 : 0.0;
  const auto hours = reader.digits(2, 4);
  if (sign == 0.0 || !hours) return std::nullopt;
  if (*hours > 99) return sign * (3600.0 * (*hours / 100) + 60.0 * (*hours % 100));
  if (!reader.take(':')) return sign * 3600.0 * *hours;
  const auto minutes = reader.digits(2, 2);
  if (!minutes) return std::nullopt;
  return sign * (3600.0 * *hours + 60.0 * *minutes);
}

bool has_date(std::string_view text) {
  const std::size_t colon = text.find(':');
  return text.substr(0, colon).find_first_of("-./") != std::string_view::npos;
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(std::string_view text) {
  if (text.find(':') == std::string_view::npos) return std::nullopt;
  StampReader reader(text);
  TimeStamp stamp;
  if (has_date(text)) {
    const auto day = take_date(reader);
    if (!day) return std::nullopt;
    stamp.seconds = *day;
    stamp.dated = true;
  }
  const auto clock = take_clock(reader);
  if (!clock) return std::nullopt;
  stamp.seconds += *clock;
  if (stamp.dated && !reader.done()) {
    const auto zone = take_zone(reader);
    if (!zone) return std::nullopt;
    stamp.seconds -= *zone;
    stamp.zoned = true;
  }
  if (!reader.done()) return std::nullopt;
  return stamp;
}

TimeColumn write_times_as_seconds(CsvTable& table, std::size_t column, std::optional<double>& origin_s) {
  TimeColumn found;
  double before_s = 0.0, days_s = 0.0;
  for (CsvRow& row : table.rows) {
    std::string& field = row.fields[column];
    const auto stamp = parse_time_stamp(field);
    const bool first = &row == &table.rows.front();
    if (first && !stamp) return found;  // numbers: their reader judges them
    if (!stamp) {
      throw InputError({table.file, row.line}, field,
                       "is no time such as 2026-11-24T19:39:57.25 or 24.11.2026 19:39:57, as the first row has");
    }
    if (first) found = {.stamps = true, .dated = stamp->dated, .zoned = stamp->zoned};
    if (stamp->dated != found.dated || stamp->zoned != found.zoned)
      throw InputError({table.file, row.line}, field, "is a time of another form than the first row's");
    if (stamp->dated && !origin_s) origin_s = kDay_s * std::floor(stamp->seconds / kDay_s);
    if (!stamp->dated && days_s > 0.0 && stamp->seconds > before_s + 0.5 * kDay_s) {
      throw InputError({table.file, row.line}, field,
                       "is more than half a day after the row before, behind a midnight: without dates it is not told "
                       "whether rows are out of order; export them in the order of time, or with dates");
    }
    if (!stamp->dated && stamp->seconds < before_s - 0.5 * kDay_s) {
      days_s += kDay_s;
      if (found.remark.empty())
        found.remark = "in line " + std::to_string(row.line) + " the clock falls to " + field +
                       ": it is taken to have passed midnight, and times count on from there";
    }
    before_s = stamp->seconds;
    field = number_text(stamp->dated ? stamp->seconds - *origin_s : stamp->seconds + days_s);
    if (table.decimal == ',') std::ranges::replace(field, '.', ',');
  }
  if (!table.units.empty()) table.units[column] = "s";
  return found;
}

}  // namespace demecal::inline tables
