// What a figure of a benchmark is held to, and the line that says whether it keeps it.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

namespace demecal::bench {

/// The values that a figure may have; none of both: any, it is there to be read.
struct Bound {
  std::optional<double> at_least{}, at_most{};

  /// Whether the figure is held to anything.
  bool holds() const { return at_least || at_most; }
  /// NaN, the figure of no case, keeps no bound.
  bool kept_by(double value) const;
};

/// "name  0.033   <= 0.05   kept"
void write_bound(std::ostream& out, const std::string& name, double value, const Bound& bound);

}  // namespace demecal::bench
