#include <fmt/format.h>

#include <algorithm>

#include "report/harmonics_chart.hpp"
#include "report/html_text.hpp"
#include "report/loop_chart.hpp"
#include "report/loop_tables.hpp"
#include "report/loop_words.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

std::vector<JsonValue> added_rounds(const JsonValue& report) {
  std::vector<JsonValue> rounds = report["rounds"].elements();
  std::erase_if(rounds, [](const JsonValue& round) { return round["verdict"].text() != "added"; });
  return rounds;
}

std::string paragraph(const std::string& markup) {
  return markup.empty() ? "" : "<p>" + markup + "</p>\n";
}

std::string search_sentence(const JsonValue& report) {
  const std::uint64_t candidates = report["candidates"].count().value_or(0);
  const std::uint64_t permutations = report["permutations"].count().value_or(0);
  if (candidates == 0) return {};
  const std::string against =
      permutations > 0 ? " against " + grouped(permutations) + " permutations of the poses" : "";
  const std::size_t added = added_rounds(report).size();
  return fmt::format("{} effects were tried in every round{}; {} {} added. ", grouped(candidates), against,
                     added == 0 ? std::string("none") : std::to_string(added), added == 1 ? "was" : "were");
}

std::string summary(const JsonValue& report) {
  const std::string stopped = stop_sentence(report["stopped"].text());
  if (stopped.empty()) return {};
  return paragraph(search_sentence(report) + escaped(stopped)) +
         paragraph(escaped(statistics_sentences({report["lack_of_fit_p"].number(), report["explained_share"].number(),
                                                 report["structure_left_p"].number()})));
}

std::string dropped(const JsonValue& report) {
  std::vector<std::string> names;
  for (const JsonValue& effect : report["dropped"].elements()) names.push_back(effect_entry(effect).name());
  if (names.empty()) return {};
  return "<p class=\"note\">Added, and taken back once others had explained the same:</p>\n" + name_list(names);
}

std::string figure(const std::string& picture, const std::string& caption) {
  if (picture.empty()) return {};
  return "<figure>" + picture + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string fall_figure(const JsonValue& report) {
  const std::optional<double> noise_mm = noise_mean_mm(report);
  const std::string noise = noise_mm ? " Dashed: what measurement noise alone would make." : "";
  return figure(loop_chart(report, noise_mm),
                "The error on the validation poses from round to round; hollow: a round that added nothing." + noise);
}

std::string harmonics_figures(const JsonValue& report) {
  std::vector<EffectEntry> effects;
  for (const JsonValue& round : added_rounds(report)) effects.push_back(effect_entry(round["effect"]));
  const auto joints = harmonics_of(effects);
  double highest = 0.0;  // one scale for all joints, lest small ones look large
  for (const auto& [joint, harmonics] : joints) {
    for (const Harmonic& harmonic : harmonics) highest = std::max(highest, harmonic.amplitude);
  }
  std::string figures;
  for (const auto& [joint, harmonics] : joints) {
    figures += figure(harmonics_chart(joint, harmonics, highest),
                      fmt::format("Joint {}: {}.", joint, escaped(harmonics_words(harmonics))));
  }
  return figures;
}

std::string pictures(const JsonValue& report) {
  const std::string figures = fall_figure(report) + harmonics_figures(report);
  return figures.empty() ? "" : "<div class=\"panel\"><div class=\"pair\">\n" + figures + "</div></div>\n";
}

}  // namespace

std::string loop_section(const JsonValue& report) {
  return section("loop", "What the model lacked",
                 summary(report) + rounds_table(report) + dropped(report) + pictures(report) + further_list(report) +
                     evidence_table(report) + not_found_table(report) + unseen_table(report) + decoys_table(report));
}

}  // namespace demecal
