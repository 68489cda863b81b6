// Words, numbers, tables and sections as they stand in the page, and its style.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline html {

/// `text` for use between tags and within quoted attributes: no character of it is taken for markup, and those that
/// HTML does not allow are replaced.
std::string escaped(std::string_view text);

/// With so many decimals, as in "0.771" or "-1.250"; in scientific notation from 1e7; a dash where there is none.
std::string fixed(std::optional<double> value, int decimals);

/// 1234567 as "1 234 567", with spaces that do not break the line.
std::string grouped_digits(std::uint64_t value);

/// The change from `before` to `after` with its sign, as in "-58 %" that does not break the line; a dash where either
/// is missing or `before` is 0.
std::string change(std::optional<double> before, std::optional<double> after);

/// A span of time in its two leading units: "41.3 s", "12 min 05 s", "3 h 07 min".
std::string duration(double seconds);

/// Names in boxes, escaped; empty where there are none.
std::string name_list(const std::vector<std::string>& names);

/// A row of a table: the first cell heads it. Cells are markup.
std::string table_row(const std::string& head, const std::vector<std::string>& cells);

/// A titled part of the page; empty where its body is.
std::string section(std::string_view id, std::string_view title, const std::string& body);

/// A panel with a table of that id; its rows scroll below its head where they are many.
std::string table_panel(const std::string& id, const std::string& head_cells, const std::string& rows,
                        std::size_t row_count);

/// CSS for light and dark screens and for paper.
std::string_view page_style();

}  // namespace demecal::inline html
