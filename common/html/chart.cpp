#include "html/chart.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "expression/evaluate.hpp"
#include "html/markup.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline html {
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

constexpr int kSamples = 400;
/// No joint errs by more: larger values come from poles and would spoil the arithmetic of the picture.
constexpr double kLargestMrad = 1e6;

struct Sample {
  double theta_deg, value_mrad;
};
/// Samples without a jump or a pole between them.
using Stretch = std::vector<Sample>;

/// The formula at evenly spaced angles strictly between two jumps.
void sample_between(const Tree& formula, double lower_rad, double upper_rad, double width_rad,
                    std::vector<Stretch>& curve) {
  const int steps = std::max(2, static_cast<int>(std::lround(kSamples * (upper_rad - lower_rad) / width_rad)));
  // Ends are taken a little inside, where the value is that of this side of the jump.
  const double inset_rad = 1e-6 * (upper_rad - lower_rad);
  Stretch stretch;
  for (int i = 0; i <= steps; ++i) {
    const double theta_rad = std::clamp(std::lerp(lower_rad, upper_rad, static_cast<double>(i) / steps),
                                        lower_rad + inset_rad, upper_rad - inset_rad);
    const double value_mrad = 1e3 * evaluate(formula, {&theta_rad, 1});
    if (std::abs(value_mrad) <= kLargestMrad) {
      stretch.push_back({degrees(theta_rad), value_mrad});
    } else if (!stretch.empty()) {
      curve.push_back(std::exchange(stretch, {}));
    }
  }
  if (!stretch.empty()) curve.push_back(std::move(stretch));
}

std::vector<Stretch> sampled(const Tree& formula, const Interval& range_rad, const std::vector<double>& jumps_rad) {
  std::vector<Stretch> curve;
  const double width_rad = range_rad.upper - range_rad.lower;
  double lower_rad = range_rad.lower;
  for (const double jump_rad : jumps_rad) {
    if (jump_rad <= lower_rad || jump_rad >= range_rad.upper) continue;
    sample_between(formula, lower_rad, jump_rad, width_rad, curve);
    lower_rad = jump_rad;
  }
  sample_between(formula, lower_rad, range_rad.upper, width_rad, curve);
  return curve;
}

/// What the picture must show, mrad: zero and the curve, but not what single peaks add to it.
Interval shown_mrad(const std::vector<Stretch>& curve) {
  std::vector<double> values{0.0};
  for (const Stretch& stretch : curve) {
    for (const Sample& sample : stretch) values.push_back(sample.value_mrad);
  }
  std::ranges::sort(values);
  const std::size_t aside = values.size() / 50;
  const Interval most{std::min(0.0, values[aside]), std::max(0.0, values[values.size() - 1 - aside])};
  const double dwarfed = 4.0 * (most.upper - most.lower);
  Interval shown{std::max(values.front(), most.lower - dwarfed), std::min(values.back(), most.upper + dwarfed)};
  if (shown.upper - shown.lower < 1e-6) shown = {shown.lower - 0.5, shown.upper + 0.5};
  const double margin = 0.06 * (shown.upper - shown.lower);
  return {shown.lower - margin, shown.upper + margin};
}

std::string jump_mark(const LineChart& chart, double jump_rad) {
  return fmt::format(
      "<line class=\"jump\" x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1}\" y2=\"{2}\"><title>jump at {3:.2f} deg</title>"
      "</line>\n",
      chart.x(degrees(jump_rad)), chart.y.from_px, chart.y.to_px, degrees(jump_rad));
}

std::string zero_line(const LineChart& chart) {
  return fmt::format("<line class=\"zero\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.2f}\" y2=\"{0:.2f}\"/>\n", chart.y(0.0),
                     chart.x.from_px, chart.x.to_px);
}

std::vector<PicturePoint> chart_points(const LineChart& chart, const Stretch& stretch) {
  std::vector<PicturePoint> points;
  for (const Sample& sample : stretch) points.emplace_back(chart.x(sample.theta_deg), chart.y(sample.value_mrad));
  return points;
}

/// As many line styles as the page's style sheet tells apart.
constexpr std::size_t kStyles = 6;

const FitnessCurves& curves_of(const FitnessHistory& history, std::uint64_t joint) {
  static const FitnessCurves none;
  const auto found = history.joints.find(joint);
  return found == history.joints.end() ? none : found->second;
}

double last_generation(const FitnessCurves& curves) {
  double last = 0.0;
  for (const auto& [island, points] : curves) {
    for (const FitnessPoint& point : points) last = std::max(last, point.generation);
  }
  return last;
}

std::vector<PicturePoint> chart_points(const LineChart& chart, const std::vector<FitnessPoint>& points) {
  std::vector<PicturePoint> places;
  for (const FitnessPoint& point : points) places.emplace_back(chart.x(point.generation), chart.y(point.best));
  return places;
}

std::string island_marks(const LineChart& chart, std::uint64_t island, const std::vector<FitnessPoint>& points) {
  if (points.empty()) return {};
  const std::string style = fmt::format("island i{}", (island - 1) % kStyles);
  const std::vector<PicturePoint> places = chart_points(chart, points);
  // The dot at the end also shows islands of a single row.
  return polyline(places, style, fmt::format("island {}", island)) +
         fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.6\"/>\n", style, places.back().first,
                     places.back().second);
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

std::string chart_svg(const LineChart& chart, const std::string& marks) {
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

std::string correction_chart(const Tree& formula, const Interval& range_rad, const std::vector<double>& jumps_rad,
                             const std::string& label) {
  const std::vector<Stretch> curve = sampled(formula, range_rad, jumps_rad);
  const Interval shown = shown_mrad(curve);
  LineChart chart = line_chart(degrees(range_rad.lower), degrees(range_rad.upper), shown.lower, shown.upper, false);
  chart.x_title = "joint angle theta, deg";
  chart.y_title = "correction, mrad";
  chart.label = label;
  std::string marks = zero_line(chart);
  for (const double jump_rad : jumps_rad) marks += jump_mark(chart, jump_rad);
  for (const Stretch& stretch : curve) marks += polyline(chart_points(chart, stretch), "curve", label);
  return chart_svg(chart, marks);
}

std::string fitness_chart(const FitnessHistory& history, std::uint64_t joint) {
  const FitnessCurves& curves = curves_of(history, joint);
  constexpr double kMargin = 1.15;
  LineChart chart = line_chart(0.0, std::max(1.0, last_generation(curves)), history.lowest / kMargin,
                               history.highest * kMargin, true);
  chart.x.to_px -= 4.0;  // room for the dots at the ends
  chart.x_title = "generation";
  chart.y_title = "best fitness";
  chart.label = fmt::format("Best fitness of the islands of joint {} over the generations", joint);
  std::string marks;
  for (const auto& [island, points] : curves) marks += island_marks(chart, island, points);
  return marks.empty() ? marks : chart_svg(chart, marks);
}

std::string fitness_caption(const FitnessHistory& history, std::uint64_t joint) {
  const FitnessPoint* best = nullptr;
  std::uint64_t best_island = 0;
  for (const auto& [island, points] : curves_of(history, joint)) {
    for (const FitnessPoint& point : points) {
      if (best != nullptr && point.best >= best->best) continue;
      best = &point;
      best_island = island;
    }
  }
  if (best == nullptr) return {};
  return fmt::format("best {:.4g} in generation {:.0f}, island {}", best->best, best->generation, best_island);
}

}  // namespace demecal::inline html
