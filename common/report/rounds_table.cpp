#include <fmt/format.h>

#include <set>

#include "report/effect_entry.hpp"
#include "report/html_text.hpp"
#include "report/loop_tables.hpp"
#include "report/loop_words.hpp"

namespace demecal {
namespace {

constexpr const char* kHead =
    "<th scope=\"row\">round</th><th class=\"words\">verdict</th><th class=\"words\">effect</th><th>size</th>"
    "<th>family-wise p</th><th>before, mm</th><th>after, mm</th><th>change</th><th class=\"words\">cannot be "
    "distinguished with these poses from</th>";

std::string words(const std::string& cell, const char* look = "") {
  return fmt::format("<td class=\"words{}\">{}</td>", look, cell);
}

std::string badge(const std::string& verdict) {
  const std::string look = verdict == "added" ? " yes" : (verdict == "rejected" ? " no" : "");
  return "<span class=\"badge" + look + "\">" + escaped(verdict) + "</span>";
}

std::string why(const std::string& sentence) {
  return sentence.empty() ? "" : "<span class=\"why\">" + escaped(sentence) + "</span>";
}

std::string rivals(const JsonValue& round) {
  std::string text;
  for (const JsonValue& rival : round["rivals"].elements()) {
    text += (text.empty() ? "" : "; ") + escaped(effect_entry(rival).name());
    if (const auto cosine = rival["cosine"].number()) text += " (cosine " + fixed(cosine, 2) + ")";
  }
  return text;
}

std::string row(const JsonValue& round, std::size_t number) {
  const EffectEntry effect = effect_entry(round["effect"]);
  const auto before = round["validation_before_mm"].number(), after = round["validation_after_mm"].number();
  const std::string class_sentence = round["class_sentence"].text();
  const std::string named =
      (class_sentence.empty() ? escaped(effect.name())
                              : "<b>" + escaped(class_sentence) + "</b>" +
                                    why("In the model it stands as " + effect.name() + "; if that is right:")) +
      why(round["diagnosis"].text()) + why(round["reason"].text());
  return fmt::format(
      "<tr><th scope=\"row\">{}</th>{}{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n",
      round["round"].count().value_or(number), words(badge(round["verdict"].text())), words(named, " wide"),
      escaped(effect.size()), probability(round["p_family"].number()), fixed(before, 3), fixed(after, 3),
      change(before, after), words(rivals(round)));
}

/// Whether any group has more than one round: only then groups are worth their lines.
bool grouped_rounds(const std::vector<JsonValue>& rounds) {
  std::set<std::uint64_t> groups;
  std::size_t numbered = 0;
  for (const JsonValue& round : rounds) {
    const std::uint64_t group = round["group"].count().value_or(0);
    if (group == 0) continue;
    ++numbered;
    groups.insert(group);
  }
  return groups.size() < numbered;
}

std::string group_row(std::uint64_t group, const JsonValue& round) {
  return fmt::format(
      "<tr class=\"group\"><th colspan=\"9\" scope=\"row\">group {}: judged against the same permutations and fitted "
      "together; structure before it, p = {}</th></tr>\n",
      group, probability(round["p_structure"].number()));
}

}  // namespace

std::string table_panel(const std::string& id, const std::string& head_cells, const std::string& rows,
                        std::size_t row_count) {
  constexpr std::size_t kMostAtOnce = 16;
  return fmt::format(
      "<div class=\"panel{}\"><table id=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      row_count > kMostAtOnce ? " long" : "", id, head_cells, rows);
}

std::string rounds_table(const JsonValue& report) {
  const std::vector<JsonValue> rounds = report["rounds"].elements();
  if (rounds.empty()) return {};
  const bool groups = grouped_rounds(rounds);
  std::string rows;
  std::uint64_t group = 0;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const std::uint64_t its = rounds[i]["group"].count().value_or(0);
    if (groups && its != group && its > 0) rows += group_row(its, rounds[i]);
    group = its;
    rows += row(rounds[i], i + 1);
  }
  return table_panel("rounds", kHead, rows, rounds.size()) +
         "<p class=\"note\">Before and after: mean tool error on the validation poses. p: the share of permutations in "
         "which the best of all candidates did as well.</p>\n";
}

}  // namespace demecal
