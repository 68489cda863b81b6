// What heads a column in tables of other programs: a name, and often a unit beside it.
#pragma once

#include <string>
#include <string_view>

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

}  // namespace demecal::inline tables
