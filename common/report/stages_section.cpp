#include <fmt/format.h>

#include "report/html_text.hpp"
#include "report/sections.hpp"
#include "report/stage_chart.hpp"

namespace demecal {
namespace {

using Cells = std::vector<std::string>;

Cells cells_of(const StageFigures& set) {
  return {fixed(set.mean_mm, 3), fixed(set.rms_mm, 3), fixed(set.p95_mm, 3), fixed(set.max_mm, 3)};
}

Cells changes(const StageFigures& before, const StageFigures& after) {
  return {change(before.mean_mm, after.mean_mm), change(before.rms_mm, after.rms_mm),
          change(before.p95_mm, after.p95_mm), change(before.max_mm, after.max_mm)};
}

std::string head(const ErrorStages& errors) {
  std::string sets, figures;
  for (const std::size_t set : errors.shown) {
    const std::string name = ErrorStages::kSets[set];
    const std::string poses = errors.poses[set] > 0 ? fmt::format(" ({})", errors.poses[set]) : "";
    sets += fmt::format("<th class=\"set first\" colspan=\"4\"><i class=\"key {0}\"></i>{0}{1}</th>", name, poses);
    figures += "<th class=\"first\">mean</th><th>rms</th><th>P95</th><th>max</th>";
  }
  return "<thead><tr><th rowspan=\"2\"></th>" + sets + "</tr>\n<tr>" + figures + "</tr></thead>\n";
}

/// A row with four figures for each shown set.
template <class FiguresOfSet>
std::string row(const ErrorStages& errors, const std::string& title, const char* css_class, FiguresOfSet figures) {
  std::string cells;
  for (const std::size_t set : errors.shown) {
    bool first = true;
    for (const std::string& cell : figures(set)) {
      cells += (first ? "<td class=\"first\">" : "<td>") + cell + "</td>";
      first = false;
    }
  }
  return fmt::format("<tr{}><th scope=\"row\">{}</th>{}</tr>\n", css_class, title, cells);
}

std::string table(const ErrorStages& errors) {
  std::string rows;
  for (const Stage& stage : errors.stages) {
    rows += row(errors, stage.title, "", [&stage](std::size_t set) { return cells_of(stage.sets[set]); });
  }
  const Stage* const registered = errors.find("registered");
  const Stage& last = errors.stages.back();
  if (registered != nullptr && registered != &last) {
    rows += row(errors, "change since base fitted", " class=\"total\"",
                [&](std::size_t set) { return changes(registered->sets[set], last.sets[set]); });
  }
  return "<div class=\"panel\"><table id=\"errors\">\n" + head(errors) + "<tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string legend(const ErrorStages& errors, bool noise) {
  std::string text = "<p class=\"legend\">";
  for (const std::size_t set : errors.shown) {
    text += fmt::format("<span><i class=\"key {0}\"></i>{0}</span>", ErrorStages::kSets[set]);
  }
  text += "<span>bar: mean, line: up to P95</span>";
  if (noise) text += "<span>dashed: the mean error that measurement noise alone would make</span>";
  return text + "</p>\n";
}

std::string last_fit_line(const JsonValue& report) {
  const JsonValue unseen = report["last_fit"]["unseen_validation_rms_mm"];
  const std::optional<double> before = unseen["before"].number(), after = unseen["after"].number();
  if (!before || !after) return {};
  return fmt::format(
      "<p class=\"note\">The numbers come from calibration and validation poses together. While the validation poses "
      "were unseen, their rms was {} mm at the start of the closed loop and {} mm at its end. Accept poses had no part "
      "in anything.</p>\n",
      fixed(before, 3), fixed(after, 3));
}

std::string index_line(const JsonValue& report) {
  const JsonValue index = report["performance_index_mm2"];
  const std::optional<double> before = index["before"].number(), after = index["after"].number();
  if (!before || !after) return {};
  return fmt::format(
      "<p class=\"note\">Performance index, the sum of squared tool errors over the calibration poses: {} mm² with the "
      "declared model, {} mm² with the final model, which model.yaml holds ({}).</p>\n",
      fixed(before, 3), fixed(after, 3), change(before, after));
}

}  // namespace

std::string stages_section(const JsonValue& report, const ErrorStages& errors) {
  if (errors.shown.empty()) return {};
  const std::optional<double> noise_mm = noise_mean_mm(report);
  return section("stages", "Tool error, stage by stage, mm",
                 table(errors) + "<div class=\"panel\">\n" + legend(errors, noise_mm.has_value()) +
                     stage_chart(errors, noise_mm) + "</div>\n" + last_fit_line(report) + index_line(report));
}

}  // namespace demecal
