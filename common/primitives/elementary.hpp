// Sine, cosine, exponential, logarithm, hyperbolic and arc tangent that give the same bits on every machine and that
// compilers can run on many rows at once.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Stands before a definition. All versions give the same bits, since no operation is contracted or reordered and fused
/// multiply-adds are written out. Sanitizers are not ready yet when the program's loader makes the choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(DEMECAL_SANITIZED)
#define DEMECAL_FOR_EACH_VECTOR_UNIT __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
/// Stands before each of several definitions of one function, of which the machine's own is called.
#define DEMECAL_VECTOR_UNIT(unit) __attribute__((target(unit)))
#else
#define DEMECAL_FOR_EACH_VECTOR_UNIT
#endif

/// Stands before a loop whose steps depend on no other step, though the compiler cannot know that the columns are
/// apart. The sanitizers' checks stand within such loops, where g++ would warn that it ignores what it was told.
#if defined(__GNUC__) && !defined(__clang__) && !defined(DEMECAL_SANITIZED)
#define DEMECAL_ROWS_APART _Pragma("GCC ivdep")
#else
#define DEMECAL_ROWS_APART
#endif

namespace demecal::inline primitives {

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

/// Where bounded_exponential() holds still.
inline constexpr double kLargestExponent = 16.0;

/// e^x - 1 = 2^k (e^r - 1) + (2^k - 1) for |x| <= 40, x = k ln 2 + r in two parts (after Cody and Waite, 1980), the
/// middle factor as a polynomial in r interpolated at Chebyshev nodes.
struct Exponential {
  double power = 1.0;      ///< 2^k
  double remainder = 0.0;  ///< e^r - 1
};
[[gnu::always_inline]] inline Exponential exponential_parts(double x) {
  constexpr double kToInteger = 0x1.8p52;  // adding it leaves the nearest integer in the low bits
  const double shifted = std::fma(x, 0x1.71547652b82fep+0, kToInteger);
  const double k = shifted - kToInteger;
  const double r = std::fma(-k, 0x1.a39ef35793c76p-33, std::fma(-k, 0x1.62e42feep-1, x));
  double tail = std::fma(r, 0x1.1f730349868cep-29, 0x1.af4de97ca4194p-26);
  tail = std::fma(r, tail, 0x1.27e4db646b17ep-22);
  tail = std::fma(r, tail, 0x1.71de0231960ebp-19);
  tail = std::fma(r, tail, 0x1.a01a01a6d889cp-16);
  tail = std::fma(r, tail, 0x1.a01a01abe7fe1p-13);
  tail = std::fma(r, tail, 0x1.6c16c16c162d4p-10);
  tail = std::fma(r, tail, 0x1.11111111100dcp-7);
  tail = std::fma(r, tail, 0x1.5555555555556p-5);
  tail = std::fma(r, tail, 0x1.5555555555557p-3);
  tail = std::fma(r, tail, 0x1.0000000000000p-1);
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(shifted) + 1023U;
  return {std::bit_cast<double>(exponent << 52), std::fma(r * r, tail, r)};
}

[[gnu::always_inline]] inline double inline_bounded_exponential(double x) {
  const double inside = x > kLargestExponent ? kLargestExponent : (x < -kLargestExponent ? -kLargestExponent : x);
  const Exponential e = exponential_parts(inside);
  return std::fma(e.power, e.remainder, e.power);
}

/// From 20 on it is 1 to rounding.
[[gnu::always_inline]] inline double inline_hyperbolic_tangent(double x) {
  const double size = std::abs(x);
  const Exponential e = exponential_parts(2.0 * (size > 20.0 ? 20.0 : size));
  const double less_one = std::fma(e.power, e.remainder, e.power - 1.0);
  return std::copysign(less_one / (less_one + 2.0), x);
}

/// ln |x| = k ln 2 + ln m with m from sqrt(1/2) to sqrt(2), ln m as an odd polynomial of (m - 1) / (m + 1) interpolated
/// at Chebyshev nodes.
[[gnu::always_inline]] inline double inline_protected_logarithm(double x) {
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd, kBias = 2048;
  const double size = std::abs(x);
  const bool subnormal = size < 0x1.0p-1022;
  const auto bits = std::bit_cast<std::uint64_t>(subnormal ? size * 0x1.0p54 : size);
  const std::uint64_t biased = (bits - kRootOfHalf + (kBias << 52)) >> 52;
  const double m = std::bit_cast<double>(bits - ((biased - kBias) << 52));
  const double k = std::bit_cast<double>(biased | 0x4330000000000000) - (0x1.0p52 + 2048.0) - (subnormal ? 54.0 : 0.0);
  const double s = (m - 1.0) / (m + 1.0);
  const double z = s * s;
  double tail = std::fma(z, 0x1.0c0aff044a970p-3, 0x1.0fbde0f4ad17bp-3);
  tail = std::fma(z, tail, 0x1.3b1c3c1c81c8fp-3);
  tail = std::fma(z, tail, 0x1.745cf8e4bba1bp-3);
  tail = std::fma(z, tail, 0x1.c71c7201a55d7p-3);
  tail = std::fma(z, tail, 0x1.2492492476a1ap-2);
  tail = std::fma(z, tail, 0x1.9999999999a39p-2);
  tail = std::fma(z, tail, 0x1.5555555555555p-1);
  const double low = std::fma(s * z, tail, k * 0x1.a39ef35793c76p-33);
  const double logarithm = std::fma(k, 0x1.62e42feep-1, std::fma(2.0, s, low));
  return x == 0.0 ? 0.0 : (size <= 0x1.fffffffffffffp1023 ? logarithm : size);
}

/// By 1/x beyond 1 and by (t - 1) / (t + 1) beyond tan(pi/8), then an odd polynomial interpolated at Chebyshev nodes.
[[gnu::always_inline]] inline double inline_arc_tangent(double x) {
  const double size = std::abs(x);
  const bool beyond = size > 1.0;
  const double t = beyond ? 1.0 / size : size;
  const bool upper = t > 0x1.a827999fcef32p-2;
  const double u = upper ? (t - 1.0) / (t + 1.0) : t;
  const double z = u * u;
  double tail = std::fma(z, 0x1.0a997ba33c1dbp-6, -0x1.1b1992aa413c9p-5);
  tail = std::fma(z, tail, 0x1.74d3a7b43351ap-5);
  tail = std::fma(z, tail, -0x1.ac7858539e493p-5);
  tail = std::fma(z, tail, 0x1.e199c62156609p-5);
  tail = std::fma(z, tail, -0x1.110e84aa36d9dp-4);
  tail = std::fma(z, tail, 0x1.3b1392a9c2d8bp-4);
  tail = std::fma(z, tail, -0x1.745d165c497f3p-4);
  tail = std::fma(z, tail, 0x1.c71c71c2fc236p-4);
  tail = std::fma(z, tail, -0x1.249249248d739p-3);
  tail = std::fma(z, tail, 0x1.9999999999952p-3);
  tail = std::fma(z, tail, -0x1.5555555555555p-2);
  const double eighths = std::fma(u * z, tail, u);
  const double within = upper ? 0x1.921fb54442d18p-1 + (eighths + 0x1.1a62633145c07p-55) : eighths;
  const double angle = beyond ? 0x1.921fb54442d18p+0 - (within - 0x1.1a62633145c07p-54) : within;
  return std::copysign(angle, x);
}

/// e^x for |x| <= 16, beyond that what it is at the nearer end; within 2 units in the last place.
double bounded_exponential(double x);
/// ln |x|, and 0 where x is 0; within 2.5 units in the last place.
double protected_logarithm(double x);
/// Within 3 units in the last place and never beyond 1.
double hyperbolic_tangent(double x);
/// Within 2.5 units in the last place.
double arc_tangent(double x);

}  // namespace demecal::inline primitives
