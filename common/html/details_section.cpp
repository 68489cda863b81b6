#include <fmt/format.h>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fitting/fit.hpp"
#include "html/markup.hpp"
#include "html/sections.hpp"
#include "kinematics/units.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

struct Unit {
  std::string name;
  int decimals = 4;
};

/// The unit that stands in a parameter's name, "base_x_mm" or "tool_rz_deg of A".
Unit unit_in_name(const std::string& name) {
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

/// The parameters of which the poses show only a combination, or nothing: those that the sentences on it name.
std::set<std::string> parameters_in_combinations(const Report& report) {
  std::set<std::string> names;
  for (const ParameterEntry& parameter : report.parameters) {
    for (const std::string& sentence : report.unidentified) {
      const std::size_t at = sentence.find(parameter.name), end = at + parameter.name.size();
      const bool is_whole = at != std::string::npos && (at == 0 || sentence[at - 1] == ' ') &&
                            (end == sentence.size() || sentence[end] == ' ' || sentence[end] == ',');
      if (is_whole) names.insert(parameter.name);
    }
  }
  return names;
}

/// Whether the poses add little to what was believed of the number before. Of a link that is its maker's figure and how
/// far makers are off; the numbers of base and tool that the same poses show only together with a link's are as
/// uncertain. Where a combination is shown, each of its numbers is its share of what was believed of all.
bool is_undetermined(const ParameterEntry& parameter, const std::string& unit, bool in_combination) {
  constexpr double kShare = 0.7, kShareInCombination = 0.1;
  if (!parameter.standard_error) return false;
  const FitOptions usual;
  const double believed = unit == "mm" ? millimetres(usual.prior_m) : degrees(usual.prior_rad);
  return *parameter.standard_error > (in_combination ? kShareInCombination : kShare) * believed;
}

std::string parameter_row(const ParameterEntry& parameter, bool in_combination) {
  const Unit unit = unit_in_name(parameter.name);
  const auto& [name, nominal, value, error] = parameter;
  const auto moved = nominal && value ? std::optional(*value - *nominal) : std::nullopt;
  if (is_undetermined(parameter, unit.name, in_combination)) {
    return table_row("<code>" + escaped(name) + "</code>",
                     {fixed(nominal, unit.decimals), "not determined", "–", "–", unit.name, "–"});
  }
  const bool seen = error && *error > 0.0;
  const std::string surely = moved && seen ? fixed(std::abs(*moved) / *error, 1) : (error ? "not identified" : "–");
  return table_row("<code>" + escaped(name) + "</code>",
                   {fixed(nominal, unit.decimals), fixed(value, unit.decimals), fixed(moved, unit.decimals),
                    seen ? fixed(error, unit.decimals) : "–", unit.name, surely});
}

std::string parameters_table(const Report& report) {
  const std::set<std::string> combined = parameters_in_combinations(report);
  std::string rows, owner;
  for (const ParameterEntry& parameter : report.parameters) {
    const std::string its = owner_of(parameter.name);
    if (its != owner) rows += "<tr class=\"group\"><th colspan=\"7\" scope=\"row\">" + escaped(its) + "</th></tr>\n";
    owner = its;
    rows += parameter_row(parameter, combined.contains(parameter.name));
  }
  if (rows.empty()) return rows;
  return "<div class=\"panel\"><table id=\"parameters\">\n<thead><tr><th scope=\"row\">parameter</th><th>nominal</th>"
         "<th>identified</th><th>change</th><th>standard error</th><th>unit</th><th>change / standard error</th></tr>"
         "</thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string unidentified(const Report& report) {
  std::string lines;
  for (const std::string& sentence : report.unidentified) lines += "<li>" + escaped(sentence) + "</li>\n";
  if (lines.empty()) return lines;
  return "<h3>What these poses do not identify</h3>\n<p class=\"note\">These combinations were held where they stood, "
         "or "
         "near it; they do not harm predictions at poses like the measured ones.</p>\n<ul class=\"plain\">\n" +
         lines + "</ul>\n";
}

std::string names_section(const char* title, const char* meaning, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  return fmt::format("<h3>{} ({})</h3>\n<p class=\"note\">{}</p>\n", title, names.size(), meaning) + name_list(names);
}

std::vector<std::string> excluded_names(const std::vector<ExcludedPose>& excluded) {
  std::vector<std::string> names;
  for (const ExcludedPose& pose : excluded) names.push_back(pose.id + " (" + fixed(pose.error_mm, 2) + " mm)");
  return names;
}

std::string fact(const std::string& what, const std::string& markup, const char* css_class = "") {
  if (markup.empty()) return {};
  return fmt::format("<div class=\"{}\"><dt>{}</dt><dd>{}</dd></div>\n", css_class, what, markup);
}

std::string count_text(std::optional<std::uint64_t> count) {
  return count ? grouped_digits(*count) : "";
}

std::string rate(const RuntimeEntry& runtime) {
  if (!runtime.evaluations || !runtime.wall_s || *runtime.wall_s <= 0.0) return {};
  const double per_s = static_cast<double>(*runtime.evaluations) / *runtime.wall_s;
  return per_s < 1e15 ? grouped_digits(static_cast<std::uint64_t>(per_s)) : "";
}

std::string code(const std::string& text) {
  return text.empty() ? text : "<code>" + escaped(text) + "</code>";
}

/// The mean over the workers.
std::string waiting(const RuntimeEntry& runtime) {
  double sum = 0.0;
  int workers = 0;
  for (const WaitingEntry& waited : runtime.waited_share) {
    if (!waited.share) continue;
    sum += *waited.share;
    ++workers;
  }
  return workers == 0 ? "" : fixed(100.0 * sum / workers, 1) + " %";
}

std::string schedule(const RuntimeEntry& runtime) {
  if (!runtime.asynchronous) return {};
  return "asynchronous: another run of this job gives another result";
}

std::string runtime_facts(const RuntimeEntry& runtime) {
  const std::optional<double>& wall_s = runtime.wall_s;
  return fact("wall time", wall_s ? duration(*wall_s) : "") + fact("workers", count_text(runtime.workers)) +
         fact("islands", count_text(runtime.islands)) + fact("generations", count_text(runtime.generations)) +
         fact("evaluations", count_text(runtime.evaluations)) + fact("evaluations per second", rate(runtime)) +
         fact("migrations", count_text(runtime.migrations)) + fact("workers' time spent waiting", waiting(runtime)) +
         fact("schedule", schedule(runtime));
}

std::string provenance(const Report& report) {
  const std::optional<std::uint64_t>& seed = report.seed;
  return fact("seed", seed ? std::to_string(*seed) : "") + fact("method", escaped(report.method)) +
         fact("demecal", escaped(report.version)) + fact("SHA-256 of the data", code(report.data_sha256), "wide");
}

}  // namespace

std::string parameters_section(const Report& report) {
  return section("identified", "Identified parameters", parameters_table(report) + unidentified(report));
}

std::string todo_section(const Report& report) {
  const Report::Poses& poses = report.poses;
  return section(
      "todo", "What to do",
      next_measurements_list(report) +
          names_section("Suspected outliers", "Down-weighted in the fit, included in all errors.", poses.outliers) +
          names_section("Excluded by name",
                        "By the data set's `exclude`: no part of any figure; in brackets their own error.",
                        excluded_names(poses.excluded)) +
          names_section("Near a singularity", "Joint errors are poorly defined there: weighed less in the evolution.",
                        poses.near_singular));
}

std::string run_section(const Report& report) {
  const std::string facts = runtime_facts(report.runtime) + provenance(report);
  return section("run", "The run", facts.empty() ? "" : "<div class=\"panel\"><dl>\n" + facts + "</dl></div>\n");
}

}  // namespace demecal::inline html
