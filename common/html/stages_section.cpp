#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "html/chart.hpp"
#include "html/markup.hpp"
#include "html/sections.hpp"
#include "report/evaluation.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

using Cells = std::vector<std::string>;
using Stages = std::vector<Stage>;

Cells cells_of(const SetErrors& set) {
  return {fixed(set.mean_mm, 3), fixed(set.rms_mm, 3), fixed(set.p95_mm, 3), fixed(set.max_mm, 3)};
}

Cells changes(const SetErrors& before, const SetErrors& after) {
  return {change(before.mean_mm, after.mean_mm), change(before.rms_mm, after.rms_mm),
          change(before.p95_mm, after.p95_mm), change(before.max_mm, after.max_mm)};
}

std::string stages_head(const Report& report, const Stages& stages) {
  std::string sets, figures;
  for (const ReportPoseSet& set : measured_sets(stages)) {
    const std::uint64_t count = report.poses.*set.poses;
    const std::string poses = count > 0 ? pose_count_words(report, set.name, count) : set.name;
    sets += fmt::format("<th class=\"set first\" colspan=\"4\"><i class=\"key {}\"></i>{}</th>", set.name, poses);
    figures += "<th class=\"first\">mean</th><th>rms</th><th>P95</th><th>max</th>";
  }
  return "<thead><tr><th rowspan=\"2\"></th>" + sets + "</tr>\n<tr>" + figures + "</tr></thead>\n";
}

/// A row with four figures for each shown set.
template <class FiguresOfSet>
std::string stage_row(const Stages& stages, const std::string& title, const char* css_class, FiguresOfSet figures) {
  std::string cells;
  for (const ReportPoseSet& set : measured_sets(stages)) {
    bool first = true;
    for (const std::string& cell : figures(set)) {
      cells += (first ? "<td class=\"first\">" : "<td>") + cell + "</td>";
      first = false;
    }
  }
  return fmt::format("<tr{}><th scope=\"row\">{}</th>{}</tr>\n", css_class, title, cells);
}

std::string stage_table(const Report& report, const Stages& stages) {
  std::string rows;
  for (const Stage& stage : stages) {
    rows += stage_row(stages, stage.title, "", [&](const ReportPoseSet& set) { return cells_of(stage.on(set)); });
  }
  const Stage* const registered = find_stage(stages, "registered");
  const Stage& last = stages.back();
  if (registered != nullptr && registered != &last) {
    rows += stage_row(stages, "change since " + registered->title, " class=\"total\"",
                      [&](const ReportPoseSet& set) { return changes(registered->on(set), last.on(set)); });
  }
  return "<div class=\"panel\"><table id=\"errors\">\n" + stages_head(report, stages) + "<tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string legend(const Stages& stages, bool noise) {
  std::string text = "<p class=\"legend\">";
  for (const ReportPoseSet& set : measured_sets(stages)) {
    text += fmt::format("<span><i class=\"key {0}\"></i>{0}</span>", set.name);
  }
  text += "<span>bar: mean, line: up to P95</span>";
  if (noise) text += "<span>dashed: the mean error that measurement noise alone would make</span>";
  return text + "</p>\n";
}

std::string last_fit_line(const Report& report) {
  const auto [before, after] = report.unseen_validation_rms_mm.value_or(BeforeAfter{});
  if (!before || !after) return {};
  return fmt::format(
      "<p class=\"note\">The numbers come from calibration and validation poses together. While the validation poses "
      "were unseen, their rms was {} mm at the start of the closed loop and {} mm at its end. Accept poses had no part "
      "in anything.</p>\n",
      fixed(before, 3), fixed(after, 3));
}

std::string outliers_line(const Report& report) {
  const std::string sentence = outliers_sentence(report);
  return sentence.empty() ? sentence : "<p class=\"note\" id=\"without-outliers\">" + escaped(sentence) + "</p>\n";
}

std::string workspace_line(const Report& report) {
  const std::string sentence = report.workspace_error ? workspace_sentence(*report.workspace_error) : "";
  return sentence.empty() ? sentence
                          : "<p class=\"note\" id=\"workspace-error\">Workspace: " + escaped(sentence) + ".</p>\n";
}

std::string index_line(const Report& report) {
  const auto& [before, after] = report.performance_index_mm2;
  if (!before || !after) return {};
  return fmt::format(
      "<p class=\"note\">Performance index, the sum of squared tool errors over the calibration poses: {} mm² with the "
      "declared model, {} mm² with the final model, which model.yaml holds ({}).</p>\n",
      fixed(before, 3), fixed(after, 3), change(before, after));
}

constexpr double kBarsWidth = 900.0, kBarsLeft = 276.0, kBarsRight = 740.0, kBarsTop = 24.0;
constexpr double kBar = 13.0, kPitch = 17.0, kGap = 16.0;

/// The largest value that a stage's bars reach.
double reach_mm(const Stage& stage) {
  double reach = 0.0;
  for (const ReportPoseSet& set : kPoseSets)
    reach = std::max({reach, stage.on(set).mean_mm.value_or(0), stage.on(set).p95_mm.value_or(0)});
  return reach;
}

/// The end of the axis: nominal bars, which hold the whole distance between two frames, count only where comparable.
double limit_mm(const Stages& stages) {
  double nominal = 0.0, others = 0.0;
  for (const Stage& stage : stages) {
    double& largest = stage.key == "nominal" ? nominal : others;
    largest = std::max(largest, reach_mm(stage));
  }
  const bool comparable = others <= 0.0 || nominal <= 2.0 * others;
  const double limit = comparable ? std::max(nominal, others) : others;
  return limit > 0.0 ? 1.02 * limit : 1.0;
}

std::string bar(const Axis& axis, double top, const SetErrors& figures, const char* set) {
  const double mean = *figures.mean_mm;
  const bool cut = mean > axis.upper;
  const double end = axis(std::min(mean, axis.upper));
  const double middle = top + 0.5 * kBar;
  std::string marks = fmt::format("<rect class=\"bar {}\" x=\"{}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\"/>", set,
                                  kBarsLeft, top, end - kBarsLeft, kBar);
  double label = end + 7.0;
  if (cut) {
    marks += fmt::format("<path class=\"cut\" d=\"M{:.1f} {:.1f} l5 -5 l-5 -5 l5 -5\"/>", end - 24.0, top + kBar + 1.0);
  } else if (figures.p95_mm) {
    const double tip = axis(std::min(*figures.p95_mm, axis.upper));
    marks += fmt::format("<path class=\"whisker\" d=\"M{:.1f} {:.1f} H{:.1f} m0 -4 v8\"/>", end, middle, tip);
    label = std::max(end, tip) + 7.0;
  }
  return marks + fmt::format("<text class=\"value\" x=\"{:.1f}\" y=\"{:.1f}\">{} mm</text>\n", label, middle + 4.0,
                             fixed(mean, 3));
}

std::string grid(const Axis& axis, double bottom) {
  std::string marks;
  for (const double tick : ticks(axis, 6)) {
    marks += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", axis(tick),
                         kBarsTop - 6.0, bottom);
    marks += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", axis(tick),
                         bottom + 16.0, tick_text(tick));
  }
  return marks + fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\">mm</text>\n", kBarsRight + 8.0, bottom + 16.0);
}

std::string noise_line(const Axis& axis, double noise_mm, double bottom) {
  if (noise_mm > axis.upper) return {};
  return fmt::format(
      "<line class=\"noise\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
      "<text class=\"tick\" x=\"{3:.1f}\" y=\"{4}\">noise alone</text>\n",
      axis(noise_mm), kBarsTop - 6.0, bottom, axis(noise_mm) - 2.0, kBarsTop - 10.0);
}

/// One group of bars per stage and one bar per measured set, from 0 to the mean with a line to P95, mm. The nominal
/// robot's bars are cut off where they would dwarf all others. `noise_mm`: the mean error that the noise of the
/// measurement alone would make, drawn where known.
std::string stage_chart(const Stages& stages, std::optional<double> noise_mm) {
  const std::vector<ReportPoseSet> sets = measured_sets(stages);
  const Axis axis{0.0, limit_mm(stages), kBarsLeft, kBarsRight, false};
  std::string bars;
  double top = kBarsTop;
  for (const Stage& stage : stages) {
    const double group = kPitch * static_cast<double>(sets.size());
    bars += fmt::format("<text class=\"stage\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kBarsLeft - 12.0,
                        top + 0.5 * group + 2.5, stage.title);
    for (const ReportPoseSet& set : sets) {
      if (stage.on(set).mean_mm) bars += bar(axis, top, stage.on(set), set.name);
      top += kPitch;
    }
    top += kGap;
  }
  const double bottom = top - kGap + 6.0;
  return fmt::format(
             "<svg class=\"chart bars\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Tool error from stage to "
             "stage\">\n",
             kBarsWidth, bottom + 24.0) +
         grid(axis, bottom) + bars + (noise_mm ? noise_line(axis, *noise_mm, bottom) : "") + "</svg>\n";
}

}  // namespace

std::string stages_section(const Report& report) {
  const Stages stages = error_stages(report);
  if (stages.empty()) return {};
  const std::optional<double> noise_mm = noise_mean_mm(report);
  return section("stages", "Tool error, stage by stage, mm",
                 stage_table(report, stages) + "<div class=\"panel\">\n" + legend(stages, noise_mm.has_value()) +
                     stage_chart(stages, noise_mm) + "</div>\n" + last_fit_line(report) + outliers_line(report) +
                     workspace_line(report) + index_line(report));
}

}  // namespace demecal::inline html
