#include "primitives/elementary.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace demecal::inline primitives {
namespace {

__extension__ using Wide = unsigned __int128;
__extension__ using SignedWide = __int128;

// 64 zeros, then the binary places of 1/pi.
constexpr std::array<std::uint64_t, 20> kOneOverPi{
    0x0000000000000000, 0x517cc1b727220a94, 0xfe13abe8fa9a6ee0, 0x6db14acc9e21c820, 0xff28b1d5ef5de2b0,
    0xdb92371d2126e970, 0x0324977504e8c90e, 0x7f0ef58e5894d39f, 0x74411afa975da242, 0x74ce38135a2fbf20,
    0x9cc8eb1cc1a99cfa, 0x4e422fc5defc941d, 0x8ffc4bffef02cc07, 0xf79788c5ad05368f, 0xb69b3f6793e584db,
    0xa7a31fb34f2ff516, 0xba93dd63f5f2f8bd, 0x9e839cfbc5294975, 0x35fdafd88fc6ae84, 0x2b0198237e3db5d5};

std::uint64_t places_of_one_over_pi(int from) {
  const auto word = static_cast<std::size_t>(from / 64);
  const int shift = from % 64;
  return shift == 0 ? kOneOverPi[word] : kOneOverPi[word] << shift | kOneOverPi[word + 1] >> (64 - shift);
}

// angle / pi modulo 2, in units of 2^-127, for angle >= 2^20 (Payne and Hanek, 1983): the angle is m 2^e, and places of
// 1/pi that contribute whole multiples of 2 are left out.
Wide half_turns(double angle) {
  const auto bits = std::bit_cast<std::uint64_t>(angle);
  const std::uint64_t m = (bits & 0xfffffffffffff) | 0x10000000000000;
  const int e = static_cast<int>(bits >> 52) - 1075;
  const int from = e + 63;
  const Wide high = static_cast<Wide>(m * places_of_one_over_pi(from)) << 64;
  const Wide middle = static_cast<Wide>(m) * places_of_one_over_pi(from + 64);
  const Wide low = static_cast<Wide>(m) * places_of_one_over_pi(from + 128);
  return high + middle + (low >> 64);
}

// (-1)^k sin(r) for an angle of k half turns and r.
double sine_of_half_turns(Wide half_turns) {
  constexpr Wide kHalf = static_cast<Wide>(1) << 126;
  const auto odd = static_cast<bool>((half_turns + kHalf) >> 127);
  const auto fraction = static_cast<SignedWide>(half_turns - (static_cast<Wide>(odd ? 1 : 0) << 127));
  const auto f = static_cast<double>(fraction);
  const auto f_rest = static_cast<double>(fraction - static_cast<SignedWide>(f));
  constexpr double kPi = 0x1.921fb54442d18p+1 * 0x1.0p-127;
  constexpr double kPiRest = 0x1.1a62633145c07p-53 * 0x1.0p-127;
  const double r = f * kPi;
  const double rest = std::fma(f, kPi, -r) + (f * kPiRest + f_rest * kPi);
  const double value = sine_within_quarter(r, rest);
  return odd ? -value : value;
}

double sine_of_large(double angle) {
  if (!std::isfinite(angle)) return std::numeric_limits<double>::quiet_NaN();
  const double size = sine_of_half_turns(half_turns(std::abs(angle)));
  return angle < 0.0 ? -size : size;
}

double cosine_of_large(double angle) {
  if (!std::isfinite(angle)) return std::numeric_limits<double>::quiet_NaN();
  return sine_of_half_turns(half_turns(std::abs(angle)) + (static_cast<Wide>(1) << 126));
}

}  // namespace

DEMECAL_FOR_EACH_VECTOR_UNIT
double sine(double angle) {
  return std::abs(angle) <= kLargestReducedAngle ? reduced_sine<false>(angle) : sine_of_large(angle);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double cosine(double angle) {
  return std::abs(angle) <= kLargestReducedAngle ? reduced_sine<true>(angle) : cosine_of_large(angle);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double bounded_exponential(double x) {
  return inline_bounded_exponential(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double protected_logarithm(double x) {
  return inline_protected_logarithm(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double hyperbolic_tangent(double x) {
  return inline_hyperbolic_tangent(x);
}

DEMECAL_FOR_EACH_VECTOR_UNIT
double arc_tangent(double x) {
  return inline_arc_tangent(x);
}

}  // namespace demecal::inline primitives
