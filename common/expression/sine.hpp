// Sine and cosine that give the same bits on every machine, and that compilers can run on many rows at once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace demecal {

/// Arguments up to this size (rad) are reduced here; beyond it, sine() and cosine() ask the C library.
inline constexpr double kLargestReducedAngle = 0x1.0p20;

/// The sine of angle + quarter_turns * pi/2 for |angle| <= kLargestReducedAngle (rad), within two units in the last
/// place and never beyond 1. Without branches. The angle is reduced by the nearest multiple of pi/2, subtracted in
/// three parts (Cody and Waite, 1980); what is left is put into one of two polynomials, interpolated at the Chebyshev
/// nodes of |r| <= pi/4.
[[gnu::always_inline]] inline double reduced_sine(double angle, std::uint64_t quarter_turns) {
  constexpr double kToInteger = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const double shifted = angle * 0x1.45f306dc9c883p-1 + kToInteger;
  const double turns = shifted - kToInteger;
  const std::uint64_t quadrant = std::bit_cast<std::uint64_t>(shifted) + quarter_turns;

  // The first two parts of pi/2 have 33 bits: their products with 20-bit integers are exact.
  const double r = ((angle - turns * 0x1.921fb544p+0) - turns * 0x1.0b4611a6p-34) - turns * 0x1.3198a2e037073p-69;
  const double z = r * r;
  double sine_tail = -0x1.ae600aca92c64p-26 + z * 0x1.5e0b05bff20f2p-33;
  sine_tail = 0x1.71de379654304p-19 + z * sine_tail;
  sine_tail = -0x1.a01a019e83816p-13 + z * sine_tail;
  sine_tail = 0x1.1111111110bb2p-7 + z * sine_tail;
  sine_tail = -0x1.5555555555555p-3 + z * sine_tail;
  const double sine_r = r + (z * r) * sine_tail;
  double cosine_tail = 0x1.1eeb68cd22f56p-29 + z * -0x1.907d8f29fe831p-37;
  cosine_tail = -0x1.27e4fa17bf139p-22 + z * cosine_tail;
  cosine_tail = 0x1.a01a019f4e9b4p-16 + z * cosine_tail;
  cosine_tail = -0x1.6c16c16c16967p-10 + z * cosine_tail;
  cosine_tail = 0x1.5555555555555p-5 + z * cosine_tail;
  const double cosine_r = 1.0 - z * (0.5 - z * cosine_tail);

  const std::uint64_t odd = std::uint64_t{0} - (quadrant & 1U);
  const std::uint64_t even_value = std::bit_cast<std::uint64_t>(sine_r) & ~odd;
  const std::uint64_t odd_value = std::bit_cast<std::uint64_t>(cosine_r) & odd;
  return std::bit_cast<double>((even_value | odd_value) ^ ((quadrant & 2U) << 62));
}

/// The sine of an angle (rad); not a number where the angle is not finite.
inline double sine(double angle) {
  return std::abs(angle) <= kLargestReducedAngle ? reduced_sine(angle, 0) : std::sin(angle);
}
/// The cosine of an angle (rad); not a number where the angle is not finite.
inline double cosine(double angle) {
  return std::abs(angle) <= kLargestReducedAngle ? reduced_sine(angle, 1) : std::cos(angle);
}

}  // namespace demecal
