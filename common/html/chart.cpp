#include "html/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html/markup.hpp"

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

/// Every second one, as often as it takes to leave no more than `most`.
std::vector<double> thinned(std::vector<double> values, std::size_t most) {
  while (values.size() > most) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
  }
  return values;
}

/// 1, 2, 5 or 10 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> linear_ticks(const Axis& axis, int wanted) {
  const double least = (axis.upper - axis.lower) / wanted;
  const double step = round_step(axis.whole ? std::max(1.0, least) : least);
  const double first = std::ceil(axis.lower / step - 1e-9);
  const double last = std::floor(axis.upper / step + 1e-9);
  std::vector<double> found;
  for (double k = first; k <= last; ++k) found.push_back(k * step);
  return found;
}

std::vector<double> logarithmic_ticks(const Axis& axis, const std::vector<double>& factors) {
  std::vector<double> found;
  const int last = static_cast<int>(std::floor(std::log10(axis.upper)));
  for (int decade = static_cast<int>(std::floor(std::log10(axis.lower))); decade <= last; ++decade) {
    for (const double factor : factors) {
      const double tick = factor * std::pow(10.0, decade);
      if (tick >= axis.lower && tick <= axis.upper) found.push_back(tick);
    }
  }
  return found;
}

}  // namespace

double Axis::operator()(double value) const {
  const double share = logarithmic ? std::log(std::max(value, lower) / lower) / std::log(upper / lower)
                                   : (value - lower) / (upper - lower);
  return from_px + share * (to_px - from_px);
}

std::vector<double> ticks(const Axis& axis, int wanted) {
  if (!axis.logarithmic) return linear_ticks(axis, wanted);
  const auto most = static_cast<std::size_t>(2 * wanted);
  std::vector<double> found = logarithmic_ticks(axis, {1.0, 2.0, 5.0});
  if (found.size() > most) found = thinned(logarithmic_ticks(axis, {1.0}), most);
  return found.size() < 3 ? linear_ticks(axis, wanted) : found;
}

std::string tick_text(double value) {
  return fmt::format("{:.6g}", value + 0.0);
}

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
