#include <fmt/format.h>

#include "report/amount.hpp"
#include "report/effect_entry.hpp"
#include "report/html_text.hpp"
#include "report/loop_tables.hpp"

namespace demecal {
namespace {

std::string titled(const char* title, const char* note, const std::string& table) {
  return fmt::format("<h3>{}</h3>\n<p class=\"note\">{}</p>\n", title, note) + table;
}

std::string not_found_row(const JsonValue& missing) {
  const auto smallest = missing["smallest_detectable"].number();
  const std::string unit = missing["unit"].text(), untestable = missing["sentence"].text();
  return table_row(escaped(effect_entry(missing).name()),
                   {smallest ? fmt::format("{:.3g}", *smallest) : "–", escaped(unit),
                    smallest             ? escaped(limit_amount(*smallest, unit))
                    : untestable.empty() ? "–"
                                         : escaped(untestable)});
}

}  // namespace

std::string not_found_table(const JsonValue& report) {
  std::string rows;
  const std::vector<JsonValue> not_found = report["not_found"].elements();
  for (const JsonValue& missing : not_found) rows += not_found_row(missing);
  if (rows.empty()) return {};
  return titled("Not found",
                "Effects of these kinds, if present, are smaller than these poses would have shown nine times out of "
                "ten; where only an implausibly large one would have shown, these data cannot tell.",
                table_panel("not-found",
                            "<th scope=\"row\">effect</th><th>smallest detectable</th><th>unit</th><th>in words</th>",
                            rows, not_found.size()));
}

std::string unseen_table(const JsonValue& report) {
  std::string rows;
  const std::vector<JsonValue> unseen = report["unseen"].elements();
  for (const JsonValue& kind : unseen) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"words\">{}</td></tr>\n", escaped(kind["kind"].text()),
                        escaped(kind["reason"].text()));
  }
  if (rows.empty()) return {};
  return titled("Not testable with these data", "Whether the arm has effects of these kinds stays open.",
                table_panel("unseen", "<th scope=\"row\">kind</th><th class=\"words\">why</th>", rows, unseen.size()));
}

std::string decoys_table(const JsonValue& report) {
  std::string rows;
  const std::vector<JsonValue> decoys = report["decoys"].elements();
  for (const JsonValue& decoy : decoys) {
    const bool won = decoy["won"].truth().value_or(false);
    rows += table_row(escaped(decoy["name"].text()),
                      {fixed(decoy["best_fall_nats"].number(), 1),
                       won ? "<span class=\"badge no\">won</span>" : "<span class=\"badge\">did not win</span>"});
  }
  if (rows.empty()) return {};
  return titled(
      "Controls",
      "Candidates that cannot be true, entered beside the others in every round: one that wins stops the loop.",
      table_panel("decoys", "<th scope=\"row\">control</th><th>best fall, nats</th><th></th>", rows, decoys.size()));
}

}  // namespace demecal
