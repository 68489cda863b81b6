// Sine and cosine that give the same bits on every machine, and that compilers can run on many rows at once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace demecal {

/// Arguments up to this size (rad) are reduced in doubles; beyond it, sine() and cosine() take longer.
inline constexpr double kLargestReducedAngle = 0x1.0p20;

/// sin(r + rest) for |r| <= pi/2 (rad), never beyond 1: r times a polynomial in r^2, interpolated at Chebyshev nodes,
/// whose last rounding is made good and whose last coefficient lies a little low, lest values at crests round to more
/// than 1. What the tiny rest adds is weighed by about cos(r).
[[gnu::always_inline]] inline double sine_within_quarter(double r, double rest) {
  const double z = r * r;
  double tail = std::fma(z, 0x1.89a3a9f12697bp-49, -0x1.ae51366b753a9p-41);
  tail = std::fma(z, tail, 0x1.612401540ed0fp-33);
  tail = std::fma(z, tail, -0x1.ae6455a1c0795p-26);
  tail = std::fma(z, tail, 0x1.71de3a54564dfp-19);
  tail = std::fma(z, tail, -0x1.a01a01a018aaap-13);
  tail = std::fma(z, tail, 0x1.1111111111107p-7);
  tail = std::fma(z, tail, -0x1.5555555555555p-3);
  const double ratio = std::fma(z, tail, 1.0);
  const double ratio_rest = std::fma(z, tail, 1.0 - ratio);
  const double cosine = std::fma(z, -0x1.9f02f6222c72p-2, 1.0);  // 1 - (2 r / pi)^2
  return std::fma(r, ratio, std::fma(r, ratio_rest, rest * cosine));
}

/// The sine, or where `cosine` the cosine, of |angle| <= kLargestReducedAngle (rad), within 1.6 units in the last place
/// and never beyond 1. Without branches. Fused multiply-adds are written out where they are meant, so that every host
/// gives the same bits. The angle is reduced by the nearest multiple of pi (for the cosine, of pi from pi/2 on),
/// subtracted in three parts of 53 bits (after Cody and Waite, 1980): the first remainder is exact, the second keeps
/// what it rounds off.
template <bool cosine>
[[gnu::always_inline]] inline double reduced_sine(double angle) {
  constexpr double kToInteger = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  constexpr double kOneOverPi = 0x1.45f306dc9c883p-2;
  const double shifted = std::fma(angle, kOneOverPi, cosine ? -0.5 : 0.0) + kToInteger;
  const double turns = (shifted - kToInteger) + (cosine ? 0.5 : 0.0);
  const double first = std::fma(-turns, 0x1.921fb54442d18p+1, angle);
  const double second = turns * 0x1.1a62633145c07p-53;
  const double rounded_off = std::fma(turns, 0x1.1a62633145c07p-53, -second);
  const double r = first - second;
  const double rest = ((first - r) - second) - std::fma(turns, -0x1.f1976b7ed8fbcp-109, rounded_off);
  // Odd half turns change the sign; where the cosine's is even, its angle is pi/2 further on.
  const std::uint64_t sign = (std::bit_cast<std::uint64_t>(shifted) ^ (cosine ? 1U : 0U)) << 63;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sine_within_quarter(r, rest)) ^ sign);
}

/// The sine of an angle (rad), within 1.6 units in the last place; not a number where the angle is not finite.
double sine(double angle);
/// The cosine of an angle (rad), within 1.6 units in the last place; not a number where the angle is not finite.
double cosine(double angle);

}  // namespace demecal
