#include <fmt/format.h>

#include "report/html_text.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

/// "backlash, joint 2"; only the kind where no joint is meant.
std::string effect_name(const JsonValue& effect) {
  std::string name = effect["kind"].text();
  const JsonValue joint = effect["joint"];
  const bool named = joint.exists() && joint.words() != "0";
  if (named) name += ", joint " + joint.words();
  return escaped(name);
}

std::string parameters(const JsonValue& effect) {
  std::string text;
  for (const auto& [name, value] : effect["parameters"].members()) {
    text += fmt::format("{}<code>{}</code> {}", text.empty() ? "" : ", ", escaped(name), escaped(value.words()));
  }
  return text;
}

std::string rivals(const JsonValue& round) {
  std::string text;
  for (const JsonValue& rival : round["rivals"].elements()) {
    text += (text.empty() ? "" : "; ") + effect_name(rival);
    if (const auto cosine = rival["cosine"].number()) text += " (cosine " + fixed(cosine, 2) + ")";
  }
  return text;
}

std::string badge(const std::string& verdict) {
  const std::string look = verdict == "added" ? " yes" : (verdict == "rejected" ? " no" : "");
  return "<span class=\"badge" + look + "\">" + escaped(verdict) + "</span>";
}

std::string probability(std::optional<double> value) {
  return value ? fmt::format("{:.3g}", *value) : "–";
}

std::string round_row(const JsonValue& round, std::size_t number) {
  const JsonValue effect = round["effect"];
  const auto before = round["validation_before_mm"].number(), after = round["validation_after_mm"].number();
  const auto words = [](const std::string& cell) { return "<td class=\"words\">" + cell + "</td>"; };
  return fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
                     round["round"].count().value_or(number), words(badge(round["verdict"].text())),
                     words(effect_name(effect)), words(parameters(effect)), probability(round["p_family"].number()),
                     fixed(before, 3), fixed(after, 3), change(before, after), words(rivals(round)));
}

std::string rounds_table(const JsonValue& report) {
  std::string rows;
  std::size_t number = 0;
  for (const JsonValue& round : report["rounds"].elements()) rows += round_row(round, ++number);
  if (rows.empty()) return {};
  return "<div class=\"panel\"><table id=\"rounds\">\n<thead><tr><th scope=\"row\">round</th><th "
         "class=\"words\">verdict"
         "</th><th class=\"words\">effect</th><th class=\"words\">parameters</th><th>family-wise p</th>"
         "<th>before, mm</th><th>after, mm</th><th>change</th><th class=\"words\">rivals these poses cannot tell apart"
         "</th></tr></thead>\n<tbody>\n" +
         rows +
         "</tbody></table></div>\n<p class=\"note\">Before and after: mean tool error on the validation poses.</p>\n";
}

std::string stop_sentence(const std::string& stopped) {
  if (stopped == "no_structure") return "The loop stopped because the error that is left shows no more structure.";
  if (stopped == "no_gain") return "The loop stopped because no further effect improved the validation poses.";
  if (stopped == "max_effects") return "The loop stopped at the largest number of effects it was allowed to add.";
  if (stopped.empty() || stopped == "not_run") return {};
  return "The loop stopped: " + escaped(stopped) + ".";
}

std::string not_found_table(const JsonValue& report) {
  std::string rows;
  for (const JsonValue& missing : report["not_found"].elements()) {
    const auto smallest = missing["smallest_detectable"].number();
    rows += table_row(effect_name(missing),
                      {smallest ? fmt::format("{:.3g}", *smallest) : "–", escaped(missing["unit"].text())});
  }
  if (rows.empty()) return {};
  return "<h3>Not found</h3>\n<p class=\"note\">Effects of these kinds, if present, are smaller than these poses could "
         "have detected.</p>\n<div class=\"panel\"><table id=\"not-found\" class=\"compact\">\n<thead><tr><th "
         "scope=\"row\">effect</th>"
         "<th>smallest detectable</th><th>unit</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace

std::string loop_section(const JsonValue& report) {
  const std::string stopped = stop_sentence(report["stopped"].text());
  return section("loop", "What the model lacked",
                 rounds_table(report) + (stopped.empty() ? "" : "<p>" + stopped + "</p>\n") + not_found_table(report));
}

}  // namespace demecal
