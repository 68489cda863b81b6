#include <fmt/format.h>

#include <cmath>

#include "report/html_text.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

struct Unit {
  std::string name;
  int decimals = 4;
};

/// The unit that stands in a parameter's name, "base_x_mm" or "tool_rz_deg of A".
Unit unit_of(const std::string& name) {
  const std::string quantity = name.substr(0, name.find(" of "));
  if (quantity.ends_with("_mm")) return {"mm", 4};
  if (quantity.ends_with("_deg")) return {"deg", 5};
  return {"", 5};
}

/// "base", "tool", "joint 2", "after link 2": what a parameter belongs to.
std::string owner_of(const std::string& name) {
  if (name.starts_with("after link ")) return name.substr(0, name.find(' ', 11));
  if (name.starts_with("joint ")) return name.substr(0, name.find(' ', 6));
  return name.substr(0, name.find('_'));
}

std::string row(const JsonValue& parameter) {
  const std::string name = parameter["name"].text();
  const Unit unit = unit_of(name);
  const auto nominal = parameter["nominal"].number(), value = parameter["value"].number();
  const auto error = parameter["standard_error"].number();
  const auto moved = nominal && value ? std::optional(*value - *nominal) : std::nullopt;
  const bool seen = error && *error > 0.0;
  const std::string surely = moved && seen ? fixed(std::abs(*moved) / *error, 1) : (error ? "not identified" : "–");
  return table_row("<code>" + escaped(name) + "</code>",
                   {fixed(nominal, unit.decimals), fixed(value, unit.decimals), fixed(moved, unit.decimals),
                    seen ? fixed(error, unit.decimals) : "–", unit.name, surely});
}

std::string table(const JsonValue& report) {
  std::string rows, owner;
  for (const JsonValue& parameter : report["parameters"].elements()) {
    const std::string its = owner_of(parameter["name"].text());
    if (its != owner) rows += "<tr class=\"group\"><th colspan=\"7\" scope=\"row\">" + escaped(its) + "</th></tr>\n";
    owner = its;
    rows += row(parameter);
  }
  if (rows.empty()) return rows;
  return "<div class=\"panel\"><table id=\"parameters\">\n<thead><tr><th scope=\"row\">parameter</th><th>nominal</th>"
         "<th>identified</th><th>change</th><th>standard error</th><th>unit</th><th>change / standard error</th></tr>"
         "</thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string unidentified(const JsonValue& report) {
  std::string lines;
  for (const std::string& sentence : report["unidentified"].texts()) lines += "<li>" + escaped(sentence) + "</li>\n";
  if (lines.empty()) return lines;
  return "<h3>What these poses do not identify</h3>\n<p class=\"note\">These combinations were held where they stood, "
         "or "
         "near it; they do not harm predictions at poses like the measured ones.</p>\n<ul class=\"plain\">\n" +
         lines + "</ul>\n";
}

std::string named(const char* title, const char* meaning, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format("<h3>{} ({})</h3>\n<p class=\"note\">{}</p>\n", title, names.size(), meaning) + name_list(names);
}

std::vector<std::string> excluded_names(const JsonValue& excluded) {
  std::vector<std::string> names;
  for (const JsonValue& pose : excluded.elements())
    names.push_back(pose["id"].text() + " (" + fixed(pose["error_mm"].number(), 2) + " mm)");
  return names;
}

}  // namespace

std::string parameters_section(const JsonValue& report) {
  return section("identified", "Identified parameters", table(report) + unidentified(report));
}

std::string poses_section(const JsonValue& report) {
  const JsonValue poses = report["poses"];
  return section(
      "poses", "Poses worth a look",
      named("Suspected outliers", "Down-weighted in the fit, included in all errors.", poses["outliers"].texts()) +
          named("Excluded by name", "By the data set's `exclude`: no part of any figure; in brackets their own error.",
                excluded_names(poses["excluded"])) +
          named("Near a singularity", "Joint errors are poorly defined there: weighed less in the evolution.",
                poses["near_singular"].texts()));
}

}  // namespace demecal
