#include <algorithm>
#include <optional>
#include <string>

#include "html/markup.hpp"
#include "html/sections.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

/// A bar as long as the spread, of the longest.
std::string spread_bar(const std::optional<double>& mm, double longest_mm, const char* colour) {
  constexpr double kWidest = 160.0;
  const double width = longest_mm > 0.0 ? kWidest * mm.value_or(0.0) / longest_mm : 0.0;
  return "<svg width=\"160\" height=\"8\" role=\"img\" aria-label=\"" + fixed(mm, 3) + " mm\"><rect width=\"" +
         fixed(width, 1) + "\" height=\"8\" fill=\"" + colour + "\"/></svg>";
}

std::string spreads(const Report& report) {
  double longest_mm = 0.0;
  for (const ContactEntry& one : report.contacts)
    longest_mm = std::max({longest_mm, one.before_rms_mm.value_or(0.0), one.after_rms_mm.value_or(0.0)});
  std::string rows;
  for (const ContactEntry& one : report.contacts) {
    rows += table_row(escaped(one.contact),
                      {escaped(one.set), escaped(one.kind), std::to_string(one.poses), fixed(one.registered_rms_mm, 3),
                       fixed(one.before_rms_mm, 3), fixed(one.after_rms_mm, 3),
                       spread_bar(one.before_rms_mm, longest_mm, "#b9c2cc") + "<br>" +
                           spread_bar(one.after_rms_mm, longest_mm, "#2f6fab")});
  }
  return table_panel("contacts",
                     "<th>contact</th><th>set</th><th>kind</th><th>poses</th><th>tool fitted, mm rms</th>"
                     "<th>before, mm rms</th><th>after, mm rms</th><th>before and after</th>",
                     rows, report.contacts.size());
}

std::string lengths(const Report& report) {
  if (report.length_errors.empty()) return {};
  std::string rows;
  for (const LengthErrorEntry& one : report.length_errors) {
    const std::string between =
        one.between.size() == 2 ? escaped(one.between.front()) + " to " + escaped(one.between.back()) : "";
    rows += table_row(between, {escaped(one.set), fixed(one.known_mm, 3), fixed(one.sigma_mm, 3),
                                fixed(one.before_mm, 3), fixed(one.error_mm, 3)});
  }
  return table_panel("lengths",
                     "<th>length between</th><th>set</th><th>known, mm</th><th>its uncertainty, mm</th>"
                     "<th>error before, mm</th><th>error after, mm</th>",
                     rows, report.length_errors.size());
}

void add_station_row(const StationEntry& station, const char* set, const SetErrors ErrorBySet::*errors,
                     std::string& rows) {
  if (!(station.after.*errors).rms_mm) return;
  rows += table_row(escaped(station.name),
                    {set, fixed((station.registered.*errors).rms_mm, 3), fixed((station.before.*errors).rms_mm, 3),
                     fixed((station.after.*errors).rms_mm, 3), fixed((station.after.*errors).max_mm, 3)});
}

}  // namespace

std::string stations_section(const Report& report) {
  if (report.stations.empty()) return {};
  std::string rows;
  for (const StationEntry& one : report.stations) {
    add_station_row(one, "calibration", &ErrorBySet::calibration, rows);
    add_station_row(one, "validation", &ErrorBySet::validation, rows);
    add_station_row(one, "accept", &ErrorBySet::accept, rows);
  }
  return section("stations", "Stations",
                 table_panel("stations",
                             "<th>station</th><th>set</th><th>tool fitted, mm rms</th><th>before, mm rms</th>"
                             "<th>after, mm rms</th><th>after, largest, mm</th>",
                             rows, report.stations.size()));
}

std::string contacts_section(const Report& report) {
  if (report.contacts.empty()) return {};
  std::string notes;
  for (const std::string& note : report.contact_notes) notes += "<li>" + escaped(note) + "</li>\n";
  return section("contacts-touched", "Contacts",
                 "<ul class=\"plain\">\n" + notes + "</ul>\n" + spreads(report) + lengths(report));
}

}  // namespace demecal::inline html
