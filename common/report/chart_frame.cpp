#include "report/chart_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html_text.hpp"

namespace demecal {
namespace {

constexpr double kWidth = 520.0, kHeight = 236.0;
constexpr double kLeft = 56.0, kRight = 510.0, kTop = 12.0, kBottom = 192.0;

std::string x_grid(const Axis& axis) {
  std::string marks;
  for (const double tick : ticks(axis, 7)) {
    const double x = axis(tick);
    marks +=
        fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", x, kTop, kBottom);
    marks += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x,
                         kBottom + 16.0, tick_text(tick));
  }
  return marks;
}

std::string y_grid(const Axis& axis) {
  std::string marks;
  for (const double tick : ticks(axis, 5)) {
    const double y = axis(tick);
    marks +=
        fmt::format("<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>", y, kLeft, kRight);
    marks += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 7.0,
                         y + 4.0, tick_text(tick));
  }
  return marks;
}

std::string titles(const LineChart& chart) {
  const double middle = 0.5 * (kTop + kBottom);
  return fmt::format(
      "<text class=\"axis\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n"
      "<text class=\"axis\" x=\"13\" y=\"{}\" text-anchor=\"middle\" transform=\"rotate(-90 13 {})\">{}</text>\n",
      kRight, kHeight - 8.0, escaped(chart.x_title), middle, middle, escaped(chart.y_title));
}

}  // namespace

LineChart line_chart(double x_lower, double x_upper, double y_lower, double y_upper, bool y_logarithmic) {
  const double least = 1e-9 * std::max({1e-9, std::abs(y_lower), std::abs(y_upper)});
  if (x_upper - x_lower < 1e-9) x_upper = x_lower + 1.0;
  if (y_upper - y_lower < least) y_upper = y_lower + least;
  return {.x = {x_lower, x_upper, kLeft, kRight, false},
          .y = {y_lower, y_upper, kBottom, kTop, y_logarithmic},
          .x_title = {},
          .y_title = {},
          .label = {}};
}

std::string drawn(const LineChart& chart, const std::string& marks) {
  // The inner picture has the coordinates of the outer one and is there to cut off what leaves the frame.
  const std::string frame = fmt::format("x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\"",
                                        kLeft, kTop, kRight - kLeft, kBottom - kTop);
  return fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth, kHeight,
                     escaped(chart.label)) +
         x_grid(chart.x) + y_grid(chart.y) + titles(chart) + "<svg " + frame + ">\n" + marks + "</svg>\n</svg>\n";
}

std::string polyline(const std::vector<PicturePoint>& points, const std::string& css_class, const std::string& title) {
  std::string places;
  for (const auto& [x, y] : points) places += fmt::format("{}{:.2f},{:.2f}", places.empty() ? "" : " ", x, y);
  return fmt::format("<polyline class=\"{}\" points=\"{}\"><title>{}</title></polyline>\n", css_class, places,
                     escaped(title));
}

}  // namespace demecal
