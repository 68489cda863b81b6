// The primitives formulas are made of: what each computes, how many arguments it takes, how it is printed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace demecal {

/// Terminals first, then the functions of thesis section 6.2: {+ - * % SIN COS SIGN SQRTp}.
enum class Primitive : std::uint8_t {
  constant, variable,                       // terminals
  add, subtract, multiply, divide,          // + - * %
  sine, cosine, sign, square_root           // SIN COS SIGN SQRTp
};

struct PrimitiveTraits {
  Primitive primitive;
  int arity;
  std::string_view symbol;  ///< as printed in the thesis's notation; empty for terminals
};

inline constexpr std::array<PrimitiveTraits, 10> kPrimitives{{
    {Primitive::constant, 0, ""},
    {Primitive::variable, 0, ""},
    {Primitive::add, 2, "+"},
    {Primitive::subtract, 2, "-"},
    {Primitive::multiply, 2, "*"},
    {Primitive::divide, 2, "%"},
    {Primitive::sine, 1, "SIN"},
    {Primitive::cosine, 1, "COS"},
    {Primitive::sign, 1, "SIGN"},
    {Primitive::square_root, 1, "SQRTp"},
}};

constexpr const PrimitiveTraits& traits(Primitive primitive) {
  return kPrimitives[static_cast<std::size_t>(primitive)];
}
constexpr int arity(Primitive primitive) { return traits(primitive).arity; }

/// a % b: 1 where b is 0 (thesis 3.3.1, note 24).
inline double protected_divide(double a, double b) { return b == 0.0 ? 1.0 : a / b; }
/// SQRTp(x) = sqrt(|x|).
inline double protected_square_root(double x) { return std::sqrt(std::abs(x)); }
/// -1, 0 or +1.
inline double sign_of(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

}  // namespace demecal
