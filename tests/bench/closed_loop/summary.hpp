// All cases of a kind in one row, all rows in the figures that the loop is held to, and the bounds of figures.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "run_case.hpp"

namespace demecal::bench {

struct Summary {
  std::string kind;
  int cases = 0;
  int eligible = 0;        ///< cases whose effect these poses can tell from all others
  int named_eligible = 0;  ///< of them, named rightly
  int named = 0;           ///< of all
  int in_class = 0;        ///< of all
  int with_false = 0;      ///< cases with an effect added that is not true
  int false_additions = 0;
  int accept = 0, within = 0;  ///< accept poses, and those within the radius that is to hold 95 % of them
  std::vector<double> before_over_floor{}, after_over_floor{};  ///< one a case
  std::vector<double> after_over_clean{};  ///< the error after over that of the twin which lacks nothing

  /// One run; `clean` is that of its twin.
  void take(const LoopFigures& figures, const LoopFigures& clean);
  void take(const Summary& other);
};

/// One row a kind of the table with cases in it, in the table's order, then `clean`, then `single`: all kinds with one
/// undeclared effect of the catalogue together.
std::vector<Summary> summaries(const std::vector<CaseFigures>& cases);

/// part / whole; 1 where the whole is nothing.
double share(int part, int whole);

/// Interpolated linearly between order statistics, as the report's 95th percentile is; NaN of nothing.
double quantile(std::vector<double> values, double share);

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
