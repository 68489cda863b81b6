// Conversions between the units of the borders (degrees, millimetres) and those inside (radians, metres).
#pragma once

#include <numbers>

namespace demecal::inline kinematics {

inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}
constexpr double metres(double millimetres) {
  return millimetres * 1e-3;
}
constexpr double millimetres(double metres) {
  return metres * 1e3;
}

}  // namespace demecal::inline kinematics
