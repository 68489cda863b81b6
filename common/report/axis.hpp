// The axis of a chart: where a value stands in the picture, and which values are written beside it.
#pragma once

#include <string>
#include <vector>

namespace demecal {

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

}  // namespace demecal
