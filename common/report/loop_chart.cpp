#include "report/loop_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart_frame.hpp"
#include "report/effect_entry.hpp"
#include "report/html_text.hpp"

namespace demecal {
namespace {

struct Step {
  double round = 0.0;
  bool added = false;
  std::optional<double> before_mm, after_mm;
  std::string name;
};

std::vector<Step> steps_of(const JsonValue& report) {
  std::vector<Step> steps;
  for (const JsonValue& round : report["rounds"].elements()) {
    const std::uint64_t number = round["round"].count().value_or(steps.size() + 1);
    Step step{.round = static_cast<double>(number),
              .added = round["verdict"].text() == "added",
              .before_mm = round["validation_before_mm"].number(),
              .after_mm = round["validation_after_mm"].number(),
              .name = effect_entry(round["effect"]).name()};
    step.added = step.added && step.after_mm;
    steps.push_back(std::move(step));
  }
  std::ranges::stable_sort(steps, {}, &Step::round);
  return steps;
}

std::string mark(const LineChart& chart, const Step& step, double level_mm) {
  const std::string words = fmt::format("round {:g}, {}: {}", step.round, step.name,
                                        step.added ? fixed(level_mm, 3) + " mm" : std::string("not added"));
  return fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.2\"><title>{}</title></circle>\n",
                     step.added ? "added" : "refused", chart.x(step.round), chart.y(level_mm), escaped(words));
}

std::string noise_mark(const LineChart& chart, double noise_mm) {
  return fmt::format("<line class=\"noise\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n",
                     chart.x.from_px, chart.x.to_px, chart.y(noise_mm));
}

}  // namespace

std::string loop_chart(const JsonValue& report, std::optional<double> noise_mm) {
  const std::vector<Step> steps = steps_of(report);
  const auto first = std::ranges::find(steps, true, &Step::added);
  if (first == steps.end() || !first->before_mm) return {};
  double level = *first->before_mm, highest = level;
  for (const Step& step : steps) highest = std::max(highest, step.added ? *step.after_mm : 0.0);
  LineChart chart = line_chart(0.0, std::max(1.0, steps.back().round), 0.0, 1.08 * highest, false);
  chart.x.to_px -= 5.0;  // room for the last mark
  chart.x.whole = true;
  chart.x_title = "round";
  chart.y_title = "validation mean, mm";
  chart.label = "Mean tool error on the validation poses over the rounds of the closed loop";
  std::vector<PicturePoint> line{{chart.x(0.0), chart.y(level)}};
  std::string marks;
  for (const Step& step : steps) {
    line.emplace_back(chart.x(step.round), chart.y(level));
    if (step.added) {
      level = *step.after_mm;
      line.emplace_back(chart.x(step.round), chart.y(level));
    }
    marks += mark(chart, step, level);
  }
  return drawn(chart, (noise_mm ? noise_mark(chart, *noise_mm) : "") +
                          polyline(line, "fall", "mean tool error on the validation poses") + marks);
}

}  // namespace demecal
