#include "expression/rounded_constant.hpp"

#include <cmath>

namespace demecal::inline expression {

double rounded_constant(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  // A power of ten divides exactly, so that the number prints with as few digits.
  const double power = std::pow(10.0, digits - 1.0 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(power) ? std::round(value * power) / power : value;
}

}  // namespace demecal::inline expression
