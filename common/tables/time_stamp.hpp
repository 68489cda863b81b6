// Times of day and dates as loggers write them, made seconds.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "data/csv.hpp"

namespace demecal::inline tables {

inline constexpr double kDay_s = 86400.0;

/// A moment: seconds since 1970 (UTC where the stamp gives a zone, else of its own clock), or since midnight where
/// there is no date.
struct TimeStamp {
  double seconds = 0.0;
  bool dated = false;
  bool zoned = false;  ///< with Z or an offset
};

/// "2026-11-24T19:39:57.250Z", "2026-11-24 19:39:57,25", "24.11.2026 19:39:57", "19:39:57.25", "7:39:57.25 PM" and the
/// like. Nothing where the text is none of these, or no such day or time exists; days between strokes (11/12/2026) may
/// be months and are none.
std::optional<TimeStamp> parse_time_stamp(std::string_view text);

/// What a column of times held.
struct TimeColumn {
  bool stamps = false;  ///< and no plain numbers
  bool dated = false;
  bool zoned = false;
  std::string remark{};  ///< for people: where a clock without dates passed midnight; empty where none did
};

/// Makes a column of time stamps one of seconds; one of numbers stays as it is. Dated stamps count from `origin_s`,
/// which becomes the midnight before the first of them where it is nothing yet. Stamps without dates count on where
/// they fall by more than half a day from one row to the next. Throws InputError where a field is neither a number nor
/// a time, or not of the first row's form.
TimeColumn write_times_as_seconds(CsvTable& table, std::size_t column, std::optional<double>& origin_s);

}  // namespace demecal::inline tables
