#include "terminal/fleet_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace demecal::inline terminal {
namespace {

/// How numbers whose names end so are shown.
struct ShownUnit {
  std::string_view suffix;  ///< of the name; empty: the name's own unit
  std::string_view unit;
  double factor;
  int decimals;  ///< of mean; -1: significant digits
};
constexpr ShownUnit kShownUnits[] = {
    {"_deg", "deg", 1.0, 5}, {"_mm", "mm", 1.0, 4}, {"_rad", "mrad", 1e3, 4}, {"_m", "mm", 1e3, 4}, {"", "", 1.0, -1}};

/// Nothing that is no more than rounding is shown as "-0.00000".
std::string fixed_mean(double value, const ShownUnit& unit) {
  if (unit.decimals < 0) return fmt::format("{:.5g}", value);
  const double step = std::pow(10.0, -unit.decimals);
  return fmt::format("{:.{}f}", std::round(value / step) * step + 0.0, unit.decimals);
}

}  // namespace

std::string fleet_table(const CalibratedModel& fleet) {
  std::size_t width = 6;
  for (const FleetNumber& one : fleet.fleet->numbers) width = std::max(width, one.name.size());
  std::string text =
      fmt::format("  {:<{}} {:>12} {:>12} {:>12}  unit\n", "number", width, "mean", "spread", "std. error");
  for (const FleetNumber& one : fleet.fleet->numbers) {
    const ShownUnit& unit = *std::ranges::find_if(
        kShownUnits, [&](const ShownUnit& shown) { return std::string_view(one.name).ends_with(shown.suffix); });
    text += fmt::format("  {:<{}} {:>12} {:>12.2g} {:>12.2g}  {}\n",
                        one.name.substr(0, one.name.size() - unit.suffix.size()), width,
                        fixed_mean(unit.factor * one.mean, unit), unit.factor * one.spread,
                        unit.factor * one.standard_error, unit.suffix.empty() ? "of the name, SI" : unit.unit);
  }
  text +=
      "  spread: standard deviation of robots of the type about the mean; std. error: that of the mean itself, which "
      "few robots do not know exactly\n";
  for (const FleetCurve& curve : fleet.fleet->curves) {
    double squares = 0.0;
    for (const double deviation : curve.wave_deviations_rad) squares += deviation * deviation;
    text += fmt::format("  correction of joint {}: robots differ by {:.2g} mrad rms over its range\n", curve.joint + 1,
                        1e3 * std::sqrt(squares));
  }
  for (const JointSummary& joint : fleet.joints)
    if (!joint.note.empty()) text += fmt::format("  correction of joint {}: none, {}\n", joint.joint + 1, joint.note);
  return text;
}

}  // namespace demecal::inline terminal
