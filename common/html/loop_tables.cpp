#include "html/sections.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "html/markup.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

constexpr const char* kRoundsHead =
    "<th scope=\"row\">round</th><th class=\"words\">verdict</th><th class=\"words\">effect</th><th>size</th>"
    "<th>family-wise p</th><th>before, mm</th><th>after, mm</th><th>change</th><th class=\"words\">cannot be "
    "distinguished with these poses from</th>";

std::string words(const std::string& cell, const char* look = "") {
  return fmt::format("<td class=\"words{}\">{}</td>", look, cell);
}

std::string badge(const std::string& verdict) {
  const std::string look = verdict == "added" ? " yes" : (verdict == "rejected" ? " no" : "");
  return "<span class=\"badge" + look + "\">" + (verdict == "none" ? "not significant" : escaped(verdict)) + "</span>";
}

std::string why(const std::string& sentence) {
  return sentence.empty() ? "" : "<span class=\"why\">" + escaped(sentence) + "</span>";
}

std::string rivals(const RoundEntry& round) {
  std::string text;
  for (const RivalEntry& rival : round.rivals) {
    text += (text.empty() ? "" : "; ") + escaped(rival.effect.full_name());
    if (rival.cosine) text += " (cosine " + fixed(rival.cosine, 2) + ")";
  }
  return text;
}

std::string round_row(const RoundEntry& round) {
  const std::optional<double>&before = round.validation_before_mm, &after = round.validation_after_mm;
  const std::string named =
      (round.class_sentence.empty()
           ? escaped(round.effect.name())
           : "<b>" + escaped(round.class_sentence) + "</b>" +
                 why("In the model it stands as " + round.effect.name() + "; if that is right:")) +
      why(round.diagnosis) + why(round.reason);
  return fmt::format(
      "<tr><th scope=\"row\">{}</th>{}{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}</tr>\n", round.round,
      words(badge(round.verdict)), words(named, " wide"), escaped(round.effect.size()), probability(round.p_family),
      fixed(before, 3), fixed(after, 3), change(before, after), words(rivals(round)));
}

/// Whether any group has more than one round: only then groups are worth their lines.
bool grouped_rounds(const std::vector<RoundEntry>& rounds) {
  std::set<std::uint64_t> groups;
  std::size_t numbered = 0;
  for (const RoundEntry& round : rounds) {
    if (round.group == 0) continue;
    ++numbered;
    groups.insert(round.group);
  }
  return groups.size() < numbered;
}

std::string group_row(const RoundEntry& round) {
  return fmt::format(
      "<tr class=\"group\"><th colspan=\"9\" scope=\"row\">group {}: judged against the same draws of the noise and "
      "fitted "
      "together; structure before it, p = {}</th></tr>\n",
      round.group, probability(round.p_structure));
}

constexpr const char* kEvidenceHead =
    "<th scope=\"row\">round</th><th class=\"words\">law</th><th class=\"words\">numbers, ± standard error, 95 % "
    "interval</th><th>structure before, p</th><th>gain, nats</th><th>confirmed (at least)</th><th>sign kept</th>";

std::string number_words(std::optional<double> value) {
  return value ? fmt::format("{:.4g}", *value) : "–";
}

/// The numbers of a round's effect, each with its standard error and interval.
std::string numbers(const RoundEntry& round) {
  std::string lines;
  for (const auto& [name, value] : round.effect.parameters) {
    std::string text = "<code>" + escaped(name) + "</code> " + number_words(value);
    if (const auto error = round.effect.standard_error(name)) text += " ± " + fmt::format("{:.2g}", *error);
    const auto interval = std::ranges::find(round.interval, name, &NamedInterval::name);
    if (interval != round.interval.end() && interval->lower && interval->upper)
      text += ", " + number_words(interval->lower) + " to " + number_words(interval->upper);
    lines += "<span>" + text + "</span>";
  }
  return lines;
}

std::string percent_of(std::optional<double> share) {
  return share ? fixed(100.0 * *share, 0) + "\u00A0%" : fixed(share, 0);
}

std::string evidence_row(const RoundEntry& round) {
  const std::string law = round.formula.empty() ? escaped(round.effect.name())
                                                : "<code class=\"law\">" + escaped(round.formula) + "</code>";
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"words wide\">{}</td><td class=\"numbers\">{}</td><td>{}</td><td>{}</td>"
      "<td>{}</td><td>{}</td></tr>\n",
      round.round, law, numbers(round), probability(round.p_structure), fixed(round.gain_nats, 1),
      percent_of(round.confirmed) + " (" + percent_of(round.confirmed_lower) + ")", percent_of(round.sign_stability));
}

std::string titled(const char* title, const std::string& note, const std::string& table) {
  return fmt::format("<h3>{}</h3>\n<p class=\"note\">{}</p>\n", title, note) + table;
}

std::string not_found_row(const NotFoundEntry& missing) {
  const std::optional<double>& smallest = missing.smallest_detectable;
  return table_row(escaped(missing.effect.full_name()),
                   {smallest ? fmt::format("{:.3g}", *smallest) : "–", escaped(missing.unit),
                    smallest             ? escaped(limit_amount(*smallest, missing.unit))
                    : missing.testable() ? "–"
                                         : escaped(missing.sentence)});
}

}  // namespace

std::string rounds_table(const Report& report) {
  if (report.rounds.empty()) return {};
  const bool groups = grouped_rounds(report.rounds);
  std::string rows;
  std::uint64_t group = 0;
  for (const RoundEntry& round : report.rounds) {
    if (groups && round.group != group && round.group > 0) rows += group_row(round);
    group = round.group;
    rows += round_row(round);
  }
  return table_panel("rounds", kRoundsHead, rows, report.rounds.size()) +
         "<p class=\"note\">Before and after: mean tool error on the validation poses. p: the share of draws of the "
         "noise in "
         "which the best of all candidates did as well.</p>\n";
}

std::string evidence_table(const Report& report) {
  std::string rows;
  std::size_t shown = 0;
  for (const RoundEntry& round : report.rounds) {
    if (round.effect.kind.empty()) continue;
    rows += evidence_row(round);
    ++shown;
  }
  if (rows.empty()) return {};
  return "<h3>The numbers behind every round</h3>\n" + table_panel("evidence", kEvidenceHead, rows, shown) +
         "<p class=\"note\">Numbers are SI. Gain: by how much the description gets shorter. Confirmed: the share of "
         "the effect's "
         "motion that the residuals of the validation poses bear out, and its one-sided 95 % bound; they gain by it "
         "where the share is above 50 %. Sign kept: the share of resamples of the poses in "
         "which the leading number keeps its sign.</p>\n";
}

std::string next_measurements_list(const Report& report) {
  std::string items;
  for (const RoundEntry& round : report.rounds) {
    if (!round.next_measurement || round.next_measurement->sentence.empty()) continue;
    items += fmt::format("<li>Round {}, {}: {}</li>\n", round.round, escaped(round.effect.name()),
                         escaped(round.next_measurement->sentence));
  }
  if (items.empty()) return {};
  return "<h3>Measure next</h3>\n<p class=\"note\">These poses cannot distinguish the named effects from "
         "their rivals. "
         "The measurements below would, nine times out of ten with so many poses.</p>\n<ul class=\"plain\" "
         "id=\"next-measurements\">\n" +
         items + "</ul>\n";
}

std::string not_found_table(const Report& report) {
  std::string rows;
  for (const NotFoundEntry& missing : report.not_found) rows += not_found_row(missing);
  if (rows.empty()) return {};
  return titled("Not found",
                "Effects of these kinds, if present, are smaller than these poses would have shown nine times out of "
                "ten; where only an implausibly large one would have shown, these data cannot tell.",
                table_panel("not-found",
                            "<th scope=\"row\">effect</th><th>smallest detectable</th><th>unit</th><th>in words</th>",
                            rows, report.not_found.size()));
}

std::string untestable_table(const Report& report) {
  std::string rows;
  for (const auto& [kind, reason] : report.untestable) {
    rows +=
        fmt::format("<tr><th scope=\"row\">{}</th><td class=\"words\">{}</td></tr>\n", escaped(kind), escaped(reason));
  }
  if (rows.empty()) return {};
  return titled(
      "Not testable with these data", "Whether the arm has effects of these kinds stays open.",
      table_panel("unseen", "<th scope=\"row\">kind</th><th class=\"words\">why</th>", rows, report.untestable.size()));
}

std::string decoys_table(const Report& report) {
  std::string rows;
  for (const DecoyEntry& decoy : report.decoys) {
    rows += table_row(escaped(decoy.name),
                      {fixed(decoy.best_gain_nats, 1),
                       decoy.won ? "<span class=\"badge no\">won</span>" : "<span class=\"badge\">did not win</span>"});
  }
  if (rows.empty()) return {};
  return titled(
      "Controls",
      "Candidates that cannot be true, entered beside the others in every round: one that wins stops the loop. Here: " +
          escaped(decoys_sentence(report.decoys)) + ".",
      table_panel("decoys", "<th scope=\"row\">control</th><th>best gain, nats</th><th></th>", rows,
                  report.decoys.size()));
}

}  // namespace demecal::inline html
