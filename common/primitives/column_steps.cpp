
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

#include "errors/check.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline primitives {
namespace {

enum class Form : std::uint8_t { column, column_constant, constant_column };
constexpr int kForms = 3;

constexpr std::uint8_t code_of(Primitive function, Form form) {
  return static_cast<std::uint8_t>(static_cast<int>(function) * kForms + static_cast<int>(form));
}

// In the loops below `out` may be an argument's own column: every row depends on itself alone.

template <class Function>
[[gnu::always_inline]] inline void unary(const double* in, double* out, std::size_t rows, Function function) {
  DEMECAL_ROWS_APART
  for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i) out[i] = function(in[i]);
}

template <class Function>
[[gnu::always_inline]] inline void binary(const double* a, const double* b, double* out, std::size_t rows,
                                          Function function) {
  DEMECAL_ROWS_APART
  for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i) out[i] = function(a[i], b[i]);
}

[[gnu::always_inline]] inline bool all_reducible(const double* angles, std::size_t rows) {
  std::int64_t beyond = 0;
  for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i)
    beyond |= std::abs(angles[i]) <= kLargestReducedAngle ? 0 : 1;
  return beyond == 0;
}

// A function of two arguments with one of them held.
template <class Function>
[[gnu::always_inline]] inline auto with_right(Function function, double b) {
  return [function, b](double a) { return function(a, b); };
}
template <class Function>
[[gnu::always_inline]] inline auto with_left(Function function, double a) {
  return [function, a](double b) { return function(a, b); };
}

constexpr auto add = [](double a, double b) { return a + b; };
constexpr auto subtract = [](double a, double b) { return a - b; };
constexpr auto multiply = [](double a, double b) { return a * b; };
constexpr auto divide = [](double a, double b) { return protected_divide(a, b); };
constexpr auto minimum = [](double a, double b) { return lesser_of(a, b); };
constexpr auto maximum = [](double a, double b) { return greater_of(a, b); };
constexpr auto square = [](double x) { return x * x; };
constexpr auto absolute = [](double x) { return std::abs(x); };

}  // namespace

ColumnStep make_step(Primitive function, const Operand& argument, double* out, bool out_whole) {
  DEMECAL_CHECK(arity(function) == 1 && argument.column != nullptr, "function=" << traits(function).symbol);
  return {argument.column, nullptr, out, 0.0, code_of(function, Form::column), argument.whole, false, out_whole};
}

ColumnStep make_step(Primitive function, const Operand& left, const Operand& right, double* out, bool out_whole) {
  DEMECAL_CHECK(arity(function) == 2 && (left.column != nullptr || right.column != nullptr),
                "function=" << traits(function).symbol);
  if (right.column == nullptr)
    return {left.column, nullptr, out,      right.constant, code_of(function, Form::column_constant),
            left.whole,  false,   out_whole};
  if (left.column == nullptr)
    return {right.column, nullptr, out,      left.constant, code_of(function, Form::constant_column),
            right.whole,  false,   out_whole};
  return {left.column, right.column, out, 0.0, code_of(function, Form::column), left.whole, right.whole, out_whole};
}

DEMECAL_FOR_EACH_VECTOR_UNIT
void run(std::span<const ColumnStep> steps, std::size_t begin, std::size_t rows) {
  for (const ColumnStep& step : steps) {
    const double* const left = step.left + (step.left_whole ? begin : 0);
    const double* const right = step.right + (step.right_whole ? begin : 0);
    double* const out = step.out + (step.out_whole ? begin : 0);
    const double constant = step.constant;
    switch (step.code) {
      case code_of(Primitive::add, Form::column):
        binary(left, right, out, rows, add);
        break;
      case code_of(Primitive::add, Form::column_constant):
        unary(left, out, rows, with_right(add, constant));
        break;
      case code_of(Primitive::add, Form::constant_column):
        unary(left, out, rows, with_left(add, constant));
        break;
      case code_of(Primitive::subtract, Form::column):
        binary(left, right, out, rows, subtract);
        break;
      case code_of(Primitive::subtract, Form::column_constant):
        unary(left, out, rows, with_right(subtract, constant));
        break;
      case code_of(Primitive::subtract, Form::constant_column):
        unary(left, out, rows, with_left(subtract, constant));
        break;
      case code_of(Primitive::multiply, Form::column):
        binary(left, right, out, rows, multiply);
        break;
      case code_of(Primitive::multiply, Form::column_constant):
        unary(left, out, rows, with_right(multiply, constant));
        break;
      case code_of(Primitive::multiply, Form::constant_column):
        unary(left, out, rows, with_left(multiply, constant));
        break;
      case code_of(Primitive::divide, Form::column):
        binary(left, right, out, rows, divide);
        break;
      case code_of(Primitive::divide, Form::column_constant):
        unary(left, out, rows, with_right(divide, constant));
        break;
      case code_of(Primitive::divide, Form::constant_column):
        unary(left, out, rows, with_left(divide, constant));
        break;
      case code_of(Primitive::sine, Form::column):
        if (all_reducible(left, rows))
          unary(left, out, rows, reduced_sine<false>);
        else
          unary(left, out, rows, sine);
        break;
      case code_of(Primitive::cosine, Form::column):
        if (all_reducible(left, rows))
          unary(left, out, rows, reduced_sine<true>);
        else
          unary(left, out, rows, cosine);
        break;
      case code_of(Primitive::sign, Form::column):
        unary(left, out, rows, sign_of);
        break;
      case code_of(Primitive::square_root, Form::column):
        unary(left, out, rows, protected_square_root);
        break;
      case code_of(Primitive::absolute, Form::column):
        unary(left, out, rows, absolute);
        break;
      case code_of(Primitive::minimum, Form::column):
        binary(left, right, out, rows, minimum);
        break;
      case code_of(Primitive::minimum, Form::column_constant):
        unary(left, out, rows, with_right(minimum, constant));
        break;
      case code_of(Primitive::minimum, Form::constant_column):
        unary(left, out, rows, with_left(minimum, constant));
        break;
      case code_of(Primitive::maximum, Form::column):
        binary(left, right, out, rows, maximum);
        break;
      case code_of(Primitive::maximum, Form::column_constant):
        unary(left, out, rows, with_right(maximum, constant));
        break;
      case code_of(Primitive::maximum, Form::constant_column):
        unary(left, out, rows, with_left(maximum, constant));
        break;
      case code_of(Primitive::logarithm, Form::column):
        unary(left, out, rows, inline_protected_logarithm);
        break;
      case code_of(Primitive::exponential, Form::column):
        unary(left, out, rows, inline_bounded_exponential);
        break;
      case code_of(Primitive::hyperbolic_tangent, Form::column):
        unary(left, out, rows, inline_hyperbolic_tangent);
        break;
      case code_of(Primitive::arc_tangent, Form::column):
        unary(left, out, rows, inline_arc_tangent);
        break;
      case code_of(Primitive::square, Form::column):
        unary(left, out, rows, square);
        break;
      default:
        break;
    }
  }
}

}  // namespace demecal::inline primitives
