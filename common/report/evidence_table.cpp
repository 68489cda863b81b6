#include <fmt/format.h>

#include "report/effect_entry.hpp"
#include "report/html_text.hpp"
#include "report/loop_tables.hpp"
#include "report/loop_words.hpp"

namespace demecal {
namespace {

constexpr const char* kHead =
    "<th scope=\"row\">round</th><th class=\"words\">law</th><th class=\"words\">numbers, ± standard error, 95 % "
    "interval</th><th>structure before, p</th><th>fall, nats</th><th>confirmed (at least)</th><th>sign kept</th>";

std::string number_words(std::optional<double> value) {
  return value ? fmt::format("{:.4g}", *value) : "–";
}

std::string line(const NamedNumber& number, const JsonValue& interval) {
  std::string text = "<code>" + escaped(number.name) + "</code> " + number_words(number.value);
  if (number.standard_error) text += " ± " + fmt::format("{:.2g}", *number.standard_error);
  const std::vector<double> ends = interval.numbers();
  if (ends.size() == 2) text += ", " + number_words(ends[0]) + " to " + number_words(ends[1]);
  return "<span>" + text + "</span>";
}

std::string numbers(const EffectEntry& effect, const JsonValue& intervals) {
  std::string lines;
  for (const NamedNumber& number : effect.parameters) lines += line(number, intervals[number.name]);
  return lines;
}

std::string percent(std::optional<double> share) {
  return share ? fixed(100.0 * *share, 0) + "\u00A0%" : fixed(share, 0);
}

std::string row(const JsonValue& round, const EffectEntry& effect, std::size_t number) {
  const std::string formula = round["formula"].text();
  const std::string law =
      formula.empty() ? escaped(effect.name()) : "<code class=\"law\">" + escaped(formula) + "</code>";
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"words wide\">{}</td><td class=\"numbers\">{}</td><td>{}</td><td>{}</td>"
      "<td>{}</td><td>{}</td></tr>\n",
      round["round"].count().value_or(number), law, numbers(effect, round["interval"]),
      probability(round["p_structure"].number()), fixed(round["fall_nats"].number(), 1),
      percent(round["confirmed"].number()) + " (" + percent(round["confirmed_lower"].number()) + ")",
      percent(round["sign_stability"].number()));
}

}  // namespace

std::string evidence_table(const JsonValue& report) {
  std::string rows;
  std::size_t number = 0, shown = 0;
  for (const JsonValue& round : report["rounds"].elements()) {
    const EffectEntry effect = effect_entry(round["effect"]);
    ++number;
    if (effect.kind.empty()) continue;
    rows += row(round, effect, number);
    ++shown;
  }
  if (rows.empty()) return {};
  return "<h3>The numbers behind every round</h3>\n" + table_panel("evidence", kHead, rows, shown) +
         "<p class=\"note\">Numbers are SI. Fall: of the description length. Confirmed: the share of the effect's "
         "motion that the residuals of the validation poses bear out, and its one-sided 95 % bound; they gain by it "
         "where the share is above 50 %. Sign kept: the share of resamples of the poses in "
         "which the leading number keeps its sign.</p>\n";
}

std::string further_list(const JsonValue& report) {
  std::string items;
  std::size_t number = 0;
  for (const JsonValue& round : report["rounds"].elements()) {
    ++number;
    const std::string sentence = round["further"]["sentence"].text();
    if (sentence.empty()) continue;
    items += fmt::format("<li>Round {}, {}: {}</li>\n", round["round"].count().value_or(number),
                         escaped(effect_entry(round["effect"]).name()), escaped(sentence));
  }
  if (items.empty()) return {};
  return "<h3>What to measure next</h3>\n<p class=\"note\">These poses cannot distinguish the named effects from "
         "their rivals. "
         "The measurements below would, nine times out of ten with so many poses.</p>\n<ul class=\"plain\" "
         "id=\"further\">\n" +
         items + "</ul>\n";
}

}  // namespace demecal
