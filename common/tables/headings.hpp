// Which line of a table heads its columns, and what the headings say: a name each, and often a unit beside it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.hpp"
#include "tables/layout.hpp"

namespace demecal::inline tables {

struct Heading {
  std::string name;
  std::string unit;  ///< as written; empty where there is none
};

/// "X [mm]", "X (mm)", "X / mm" and "X, mm" as name and unit; a heading in another form is all name. What stands in
/// round brackets, after a stroke or after a comma is a unit only where it is a known one: "Tool (left)" is a name.
Heading split_heading(std::string_view text);

/// The unit of a field that holds nothing but one, as in a row of units below the headings: "[mm]", "mm", "(deg)";
/// empty where the field is something else.
std::string lone_unit(std::string_view field);

struct Headings {
  std::size_t line = 0;             ///< in the file, from 1; 0: there are none
  std::vector<std::string> fields;  ///< as they stand there, one a column
  std::vector<std::string> units;   ///< of a row of units below them; empty: there is none
  bool in_comment = false;
  std::size_t lines_before = 0;  ///< that are neither comments nor blank
};

/// The headings of the rows that begin at layout.first_row. Throws InputError where a line before the rows may be a row
/// or the headings, but has another width, and where two lines may be the headings.
Headings find_headings(const std::vector<TextLine>& lines, const Layout& layout, const ToldLayout& told,
                       const std::string& file);

/// Names, units and headings of the table's columns.
void set_columns(const Headings& headings, std::size_t width, CsvTable& table);

}  // namespace demecal::inline tables
