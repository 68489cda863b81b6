// The primitives formulas are made of: what each computes, how many arguments it takes, how it is printed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "primitives/elementary.hpp"

namespace demecal::inline primitives {

/// Terminals first, then the functions of thesis section 6.2: {+ - * % SIN COS SIGN SQRTp}, then later ones. Their
/// numbers go over the wire: new ones come last.
enum class Primitive : std::uint8_t {
  constant,
  variable,  // terminals
  add,
  subtract,
  multiply,
  divide,  // + - * %
  sine,
  cosine,
  sign,
  square_root,  // SIN COS SIGN SQRTp
  absolute,     // ABS
  logarithm,
  exponential,
  hyperbolic_tangent,
  arc_tangent,  // LOGp EXPb TANH ATAN
  square,
  minimum,
  maximum  // SQUARE MIN MAX
};

struct PrimitiveTraits {
  Primitive primitive;
  int arity;
  std::string_view symbol;  ///< as printed in the thesis's notation; empty for terminals
};

inline constexpr std::array<PrimitiveTraits, 18> kPrimitives{{
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
    {Primitive::absolute, 1, "ABS"},
    {Primitive::logarithm, 1, "LOGp"},
    {Primitive::exponential, 1, "EXPb"},
    {Primitive::hyperbolic_tangent, 1, "TANH"},
    {Primitive::arc_tangent, 1, "ATAN"},
    {Primitive::square, 1, "SQUARE"},
    {Primitive::minimum, 2, "MIN"},
    {Primitive::maximum, 2, "MAX"},
}};

constexpr const PrimitiveTraits& traits(Primitive primitive) {
  return kPrimitives[static_cast<std::size_t>(primitive)];
}
constexpr int arity(Primitive primitive) {
  return traits(primitive).arity;
}

/// a % b: 1 where b is 0 (thesis 3.3.1, note 24).
inline double protected_divide(double a, double b) {
  const double quotient = a / b;  // computed for every b, so that loops over rows need no branch
  return b == 0.0 ? 1.0 : quotient;
}
/// SQRTp(x) = sqrt(|x|).
inline double protected_square_root(double x) {
  return std::sqrt(std::abs(x));
}
/// -1, 0 or +1; not a number stays so, lest a failed evaluation look like a value.
inline double sign_of(double x) {
  return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x);
}
/// The lesser of two, and the greater; not a number where one of them is none, lest a failed evaluation look like a
/// value.
inline double lesser_of(double a, double b) {
  return a < b || a != a ? a : b;
}
inline double greater_of(double a, double b) {
  return a > b || a != a ? a : b;
}

/// The value of a function of one argument; 0 for primitives of another arity.
inline double value_of(Primitive function, double argument) {
  switch (function) {
    case Primitive::sine:
      return sine(argument);
    case Primitive::cosine:
      return cosine(argument);
    case Primitive::sign:
      return sign_of(argument);
    case Primitive::square_root:
      return protected_square_root(argument);
    case Primitive::absolute:
      return std::abs(argument);
    case Primitive::logarithm:
      return protected_logarithm(argument);
    case Primitive::exponential:
      return bounded_exponential(argument);
    case Primitive::hyperbolic_tangent:
      return hyperbolic_tangent(argument);
    case Primitive::arc_tangent:
      return arc_tangent(argument);
    case Primitive::square:
      return argument * argument;
    default:
      return 0.0;
  }
}
/// The value of a function of two arguments; 0 for primitives of another arity.
inline double value_of(Primitive function, double left, double right) {
  switch (function) {
    case Primitive::add:
      return left + right;
    case Primitive::subtract:
      return left - right;
    case Primitive::multiply:
      return left * right;
    case Primitive::divide:
      return protected_divide(left, right);
    case Primitive::minimum:
      return lesser_of(left, right);
    case Primitive::maximum:
      return greater_of(left, right);
    default:
      return 0.0;
  }
}

}  // namespace demecal::inline primitives
