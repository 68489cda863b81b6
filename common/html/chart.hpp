// Charts as inline SVG: axes with their ticks, what all line charts share, and the charts of a joint.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "report/history.hpp"

namespace demecal::inline html {

/// Where a value stands in the picture, and which values are written beside it.
struct Axis {
  double lower = 0.0;  ///< below upper; above 0 where logarithmic
  double upper = 1.0;
  double from_px = 0.0;  ///< where lower stands
  double to_px = 1.0;    ///< where upper stands; less than from_px on an axis that points up
  bool logarithmic = false;
  bool whole = false;  ///< ticks at whole numbers only

  /// Where `value` stands, px. On a logarithmic axis what is not above 0 stands at `lower`.
  double operator()(double value) const;
};

/// Round values within the axis, ascending: about `wanted` of them, 1, 2 or 5 times powers of ten apart. On a
/// logarithmic axis those values themselves, fewer over many decades; over a short stretch as on a linear one.
std::vector<double> ticks(const Axis& axis, int wanted);

std::string tick_text(double value);

/// A point in the picture, px.
using PicturePoint = std::pair<double, double>;

struct LineChart {
  Axis x, y;
  std::string x_title, y_title;  ///< plain text
  std::string label;             ///< plain text, for those who cannot see the picture
};

/// Axes over these values, in the place every line chart has. Ranges of no width are widened.
LineChart line_chart(double x_lower, double x_upper, double y_lower, double y_upper, bool y_logarithmic);

/// The picture with `marks` (SVG) drawn over the grid and cut off at the frame.
std::string chart_svg(const LineChart& chart, const std::string& marks);

/// A line through the points, told apart by its CSS class; `title` (plain text) shows on pointing at it.
std::string polyline(const std::vector<PicturePoint>& points, const std::string& css_class, const std::string& title);

/// The correction in mrad over the joint angle in degrees, as inline SVG, with a line at zero and marks at its jumps,
/// where the curve is broken. Where single peaks dwarf the rest (poles), they leave the picture at its edge. `formula`
/// has the one variable theta and gives rad; `range_rad` is finite and not empty; `jumps_rad` ascend.
std::string correction_chart(const Tree& formula, const Interval& range_rad, const std::vector<double>& jumps_rad,
                             const std::string& label);

/// One line per island with one point per row of the history, fitness on a logarithmic scale that all joints of
/// `history` share, as inline SVG. Empty where the joint has no points.
std::string fitness_chart(const FitnessHistory& history, std::uint64_t joint);

/// The best of all: "best 1.23 in generation 200, island 2"; empty where the joint has no points.
std::string fitness_caption(const FitnessHistory& history, std::uint64_t joint);

}  // namespace demecal::inline html
