// What the line charts of the page share: their size, grid, ticks and titles, as inline SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/axis.hpp"

namespace demecal {

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
std::string drawn(const LineChart& chart, const std::string& marks);

/// A line through the points, told apart by its CSS class; `title` (plain text) shows on pointing at it.
std::string polyline(const std::vector<PicturePoint>& points, const std::string& css_class, const std::string& title);

}  // namespace demecal
