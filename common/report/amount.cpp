#include "report/amount.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace demecal {
namespace {

/// Significant digits, but never an exponent for what has up to six digits before the point.
std::string digits(double value, int significant) {
  const double size = std::abs(value);
  const bool whole = size >= std::pow(10.0, significant - 1) && size < 1e6;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, significant);
}

/// `value` in thousandths or millionths of the unit whose name follows the prefix.
std::string small_part(double value, const std::string& unit, int significant) {
  const bool tiny = value != 0.0 && std::abs(value) < 1e-5;
  return digits(value * (tiny ? 1e6 : 1e3), significant) + (tiny ? " µ" : " m") + unit;
}

/// What stands after the "1" of "1/K"; empty for a plain share.
std::string per(const std::string& unit) {
  return unit.size() > 1 ? unit.substr(1) : "";
}

std::string worded(double value, const std::string& unit, int significant) {
  if (!std::isfinite(value)) return "–";
  if (unit.starts_with("rad") || unit == "m" || unit.starts_with("m/")) return small_part(value, unit, significant);
  if (unit == "1" || unit.starts_with("1/")) return digits(1e6 * value, significant) + " ppm" + per(unit);
  return digits(value, significant) + (unit.empty() ? "" : " " + unit);
}

}  // namespace

std::string amount(double value, const std::string& unit) {
  return worded(value, unit, 3);
}

std::string limit_amount(double value, const std::string& unit) {
  constexpr double kArcsecondsPerRadian = 648000.0 / std::numbers::pi;
  const double angle_arcsec = kArcsecondsPerRadian * value;
  if (unit == "rad" && std::isfinite(value) && std::abs(angle_arcsec) < 3600.0)
    return digits(angle_arcsec, 2) + " arcsec";
  return worded(value, unit, 2);
}

}  // namespace demecal
