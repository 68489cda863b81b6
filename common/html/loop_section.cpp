#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "html/chart.hpp"
#include "html/markup.hpp"
#include "html/sections.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

std::string paragraph(const std::string& markup) {
  return markup.empty() ? "" : "<p>" + markup + "</p>\n";
}

std::string search_sentence(const Report& report) {
  if (report.candidates == 0) return {};
  const std::string against =
      report.null_draws > 0 ? " against " + grouped_digits(report.null_draws) + " draws of the noise" : "";
  const auto added = std::ranges::count_if(report.rounds, &RoundEntry::added);
  return fmt::format("{} effects were tried in every round{}; {} {} added. ", grouped_digits(report.candidates),
                     against, added == 0 ? std::string("none") : std::to_string(added), added == 1 ? "was" : "were");
}

std::string loop_summary(const Report& report) {
  const std::string stopped = stop_sentence(report.stopped);
  if (stopped.empty()) return {};
  return paragraph(search_sentence(report) + escaped(stopped)) + paragraph(escaped(statistics_sentences(report))) +
         (report.noise ? paragraph(escaped("Noise: " + noise_sentence(*report.noise) + ".")) : "");
}

constexpr std::array kCauseFigures{"of the error, mm", "95 %", "error without it", "with it", "effects", "what to do"};

/// What it comes to: a row a cause, with what to do about it.
std::string causes_table(const Report& report) {
  if (report.causes.empty()) return {};
  std::string rows;
  for (const CauseEntry& cause : report.causes) {
    const std::string interval = cause.interval_mm.size() == 2
                                     ? fmt::format("{:.3f} to {:.3f}", cause.interval_mm[0], cause.interval_mm[1])
                                     : "";
    const std::array<std::string, 6> cells{fixed(cause.cost_mm(), 3),
                                           interval,
                                           fixed(cause.without_mm, 3),
                                           fixed(cause.with_mm, 3),
                                           std::to_string(cause.effects.size()),
                                           escaped(cause.advice)};
    rows += "<tr><th scope=\"row\">" + escaped(cause_name(cause)) + "</th>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      rows += fmt::format("<td data-name=\"{}\">{}</td>", kCauseFigures[i], cells[i]);
    rows += "</tr>\n";
  }
  std::string heads = "<th>cause</th>";
  for (const char* const figure : kCauseFigures) heads += fmt::format("<th>{}</th>", figure);
  return table_panel("causes", heads, rows, report.causes.size()) +
         fmt::format(
             "<p class=\"note\">By how much the rms error of {} poses, while they were unseen, rises when a cause is "
             "left "
             "out and all else is fitted again, to first order; \"of the error\" is the root of the difference of "
             "squares, "
             "0 where the error falls.</p>\n",
             judging_set(report));
}

/// What no cause explains.
std::string unexplained_paragraph(const Report& report) {
  if (!report.unexplained) return {};
  return paragraph(escaped(unexplained_sentence(*report.unexplained) + ' ' + report.unexplained->advice));
}

/// The best model of every number of causes.
std::string front_table(const Report& report) {
  if (report.front.size() < 3) return {};
  std::string rows;
  for (const FrontEntry& point : report.front) {
    rows += table_row(std::to_string(point.causes) + (point.chosen ? ", the model" : ""),
                      {fixed(point.validation_rms_mm, 3), fixed(point.accept_rms_mm, 3)});
  }
  return table_panel("front",
                     fmt::format("<th>causes</th><th>{}, rms mm</th><th>accept, rms mm</th>", judging_set(report)),
                     rows, report.front.size());
}

std::string dropped(const Report& report) {
  std::vector<std::string> names;
  for (const EffectEntry& effect : report.dropped) names.push_back(effect.full_name());
  if (names.empty()) return {};
  return "<p class=\"note\">Added, and taken back once others had explained the same:</p>\n" + name_list(names);
}

/// A round that added something, and can be drawn.
bool steps_down(const RoundEntry& round) {
  return round.added() && round.validation_after_mm;
}

std::string round_mark(const LineChart& chart, const RoundEntry& round, double level_mm) {
  const std::string words = fmt::format("round {}, {}: {}", round.round, round.effect.name(),
                                        steps_down(round) ? fixed(level_mm, 3) + " mm" : std::string("not added"));
  return fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.2\"><title>{}</title></circle>\n",
                     steps_down(round) ? "added" : "refused", chart.x(static_cast<double>(round.round)),
                     chart.y(level_mm), escaped(words));
}

std::string noise_mark(const LineChart& chart, double noise_mm) {
  return fmt::format("<line class=\"noise\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n",
                     chart.x.from_px, chart.x.to_px, chart.y(noise_mm));
}

/// The mean tool error (mm) on the validation poses after each round, from 0: a step down where an effect was added, a
/// hollow mark where none was. `noise_mm`: the mean error that noise alone would make, drawn where known. Empty where
/// no round added anything or the errors are missing.
std::string loop_chart(const Report& report, std::optional<double> noise_mm) {
  std::vector<RoundEntry> rounds = report.rounds;
  std::ranges::stable_sort(rounds, {}, &RoundEntry::round);
  const auto first = std::ranges::find_if(rounds, steps_down);
  if (first == rounds.end() || !first->validation_before_mm) return {};
  double level = *first->validation_before_mm, highest = level;
  for (const RoundEntry& round : rounds)
    highest = std::max(highest, steps_down(round) ? *round.validation_after_mm : 0.0);
  LineChart chart =
      line_chart(0.0, std::max(1.0, static_cast<double>(rounds.back().round)), 0.0, 1.08 * highest, false);
  chart.x.to_px -= 5.0;  // room for the last mark
  chart.x.whole = true;
  chart.x_title = "round";
  chart.y_title = "validation mean, mm";
  chart.label = "Mean tool error on the validation poses over the rounds of the closed loop";
  std::vector<PicturePoint> line{{chart.x(0.0), chart.y(level)}};
  std::string marks;
  for (const RoundEntry& round : rounds) {
    const double x = chart.x(static_cast<double>(round.round));
    line.emplace_back(x, chart.y(level));
    if (steps_down(round)) {
      level = *round.validation_after_mm;
      line.emplace_back(x, chart.y(level));
    }
    marks += round_mark(chart, round, level);
  }
  return chart_svg(chart, (noise_mm ? noise_mark(chart, *noise_mm) : "") +
                              polyline(line, "fall", "mean tool error on the validation poses") + marks);
}

std::string stem(const LineChart& chart, const Harmonic& harmonic) {
  const double x = chart.x(harmonic.cycles), top = chart.y(1e3 * harmonic.amplitude);
  std::string marks = fmt::format("<line class=\"stem\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.2f}\" y2=\"{2:.2f}\"/>",
                                  x, chart.y(0.0), top);
  if (harmonic.standard_error) {
    marks += fmt::format("<path class=\"whisker\" d=\"M{0:.2f} {1:.2f} V{2:.2f} m-3 0 h6\"/>", x,
                         chart.y(1e3 * (harmonic.amplitude - *harmonic.standard_error)),
                         chart.y(1e3 * (harmonic.amplitude + *harmonic.standard_error)));
  }
  const std::string words =
      fmt::format("{:g} cycles per turn: {}", harmonic.cycles, amount(harmonic.amplitude, harmonic.unit));
  return marks +
         fmt::format("<circle class=\"stem\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.4\"><title>{}</title></circle>\n", x,
                     top, escaped(words));
}

/// A stem per harmonic at its cycles per turn, as high as its amplitude (mrad or mm, up to `highest`, SI) with a
/// whisker of a standard error to either side.
std::string harmonics_chart(std::uint64_t joint, const std::vector<Harmonic>& harmonics, double highest) {
  LineChart chart = line_chart(0.0, 1.04 * harmonics.back().cycles, 0.0, 1.12e3 * highest, false);
  chart.x.whole = true;
  chart.x_title = "cycles per turn";
  chart.y_title = "m" + harmonics.front().unit;
  chart.label = fmt::format("Amplitudes of the gear harmonics of joint {}", joint);
  std::string marks;
  for (const Harmonic& harmonic : harmonics) marks += stem(chart, harmonic);
  return chart_svg(chart, marks);
}

std::string figure(const std::string& picture, const std::string& caption) {
  if (picture.empty()) return {};
  return "<figure>" + picture + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string decrease_figure(const Report& report) {
  const std::optional<double> noise_mm = noise_mean_mm(report);
  const std::string noise = noise_mm ? " Dashed: what measurement noise alone would make." : "";
  return figure(loop_chart(report, noise_mm),
                "The error on the validation poses from round to round; hollow: a round that added nothing." + noise);
}

std::string harmonics_figures(const Report& report) {
  std::vector<EffectEntry> effects;
  for (const RoundEntry& round : report.rounds) {
    if (round.added()) effects.push_back(round.effect);
  }
  const auto joints = harmonics_of(effects);
  double highest = 0.0;  // one scale for all joints, lest small ones look large
  for (const auto& [joint, harmonics] : joints) {
    for (const Harmonic& harmonic : harmonics) highest = std::max(highest, harmonic.amplitude);
  }
  std::string figures;
  for (const auto& [joint, harmonics] : joints) {
    figures += figure(harmonics_chart(joint, harmonics, highest),
                      fmt::format("Joint {}: {}.", joint, escaped(harmonics_text(harmonics))));
  }
  return figures;
}

std::string pictures(const Report& report) {
  const std::string figures = decrease_figure(report) + harmonics_figures(report);
  return figures.empty() ? "" : "<div class=\"panel\"><div class=\"pair\">\n" + figures + "</div></div>\n";
}

}  // namespace

std::string causes_section(const Report& report) {
  return section("causes-found", "What the model lacked", causes_table(report) + unexplained_paragraph(report));
}

std::string loop_section(const Report& report) {
  return section("loop", "How it was found, round by round",
                 loop_summary(report) + front_table(report) + rounds_table(report) + dropped(report) +
                     pictures(report) + evidence_table(report));
}

std::string not_found_section(const Report& report) {
  return section("loop-limits", "What was not found",
                 not_found_table(report) + untestable_table(report) + decoys_table(report));
}

}  // namespace demecal::inline html
