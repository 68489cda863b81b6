#include "report/stage_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/axis.hpp"
#include "report/html_text.hpp"

namespace demecal {
namespace {

constexpr double kWidth = 900.0, kLeft = 190.0, kRight = 740.0, kTop = 24.0;
constexpr double kBar = 13.0, kPitch = 17.0, kGap = 16.0;

/// The largest value that a stage's bars reach.
double reach_mm(const Stage& stage) {
  double reach = 0.0;
  for (const StageFigures& set : stage.sets) reach = std::max({reach, set.mean_mm.value_or(0), set.p95_mm.value_or(0)});
  return reach;
}

/// The end of the axis: nominal bars, which hold the whole distance between two frames, count only where comparable.
double limit_mm(const ErrorStages& errors) {
  double nominal = 0.0, others = 0.0;
  for (const Stage& stage : errors.stages) {
    double& largest = stage.key == "nominal" ? nominal : others;
    largest = std::max(largest, reach_mm(stage));
  }
  const bool comparable = others <= 0.0 || nominal <= 2.0 * others;
  const double limit = comparable ? std::max(nominal, others) : others;
  return limit > 0.0 ? 1.02 * limit : 1.0;
}

std::string bar(const Axis& axis, double top, const StageFigures& figures, const char* set) {
  const double mean = *figures.mean_mm;
  const bool cut = mean > axis.upper;
  const double end = axis(std::min(mean, axis.upper));
  const double middle = top + 0.5 * kBar;
  std::string marks = fmt::format("<rect class=\"bar {}\" x=\"{}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\"/>", set,
                                  kLeft, top, end - kLeft, kBar);
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
                         kTop - 6.0, bottom);
    marks += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", axis(tick),
                         bottom + 16.0, tick_text(tick));
  }
  return marks + fmt::format("<text class=\"axis\" x=\"{}\" y=\"{}\">mm</text>\n", kRight + 8.0, bottom + 16.0);
}

std::string noise_line(const Axis& axis, double noise_mm, double bottom) {
  if (noise_mm > axis.upper) return {};
  return fmt::format(
      "<line class=\"noise\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
      "<text class=\"tick\" x=\"{3:.1f}\" y=\"{4}\">noise alone</text>\n",
      axis(noise_mm), kTop - 6.0, bottom, axis(noise_mm) - 2.0, kTop - 10.0);
}

}  // namespace

std::string stage_chart(const ErrorStages& errors, std::optional<double> noise_mm) {
  if (errors.shown.empty()) return {};
  const Axis axis{0.0, limit_mm(errors), kLeft, kRight, false};
  std::string bars;
  double top = kTop;
  for (const Stage& stage : errors.stages) {
    const double group = kPitch * static_cast<double>(errors.shown.size());
    bars += fmt::format("<text class=\"stage\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 12.0,
                        top + 0.5 * group + 2.5, stage.title);
    for (const std::size_t set : errors.shown) {
      if (stage.sets[set].mean_mm) bars += bar(axis, top, stage.sets[set], ErrorStages::kSets[set]);
      top += kPitch;
    }
    top += kGap;
  }
  const double bottom = top - kGap + 6.0;
  return fmt::format(
             "<svg class=\"chart bars\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Tool error from stage to "
             "stage\">\n",
             kWidth, bottom + 24.0) +
         grid(axis, bottom) + bars + (noise_mm ? noise_line(axis, *noise_mm, bottom) : "") + "</svg>\n";
}

}  // namespace demecal
