#include "symbolic/fold_constants.hpp"

#include <algorithm>
#include <cmath>

#include "errors/check.hpp"
#include "expression/primitive.hpp"

namespace demecal {

double value_of(Function function, std::span<const double> arguments) {
  const double a = arguments[0];
  switch (function) {
    case Function::sine:
      return std::sin(a);
    case Function::cosine:
      return std::cos(a);
    case Function::hyperbolic_tangent:
      return std::tanh(a);
    case Function::sign:
      return sign_of(a);
    case Function::absolute:
      return std::abs(a);
    case Function::square_root:
      return std::sqrt(a);
    case Function::round:
      return std::round(a);
    case Function::minimum:
      return std::min(a, arguments[1]);
    case Function::maximum:
      return std::max(a, arguments[1]);
    case Function::divide_or_one:
      return protected_divide(a, arguments[1]);
    case Function::divide_or_zero:
      return arguments[1] == 0.0 ? 0.0 : a / arguments[1];
    case Function::if_not_negative:
      return a >= 0.0 ? arguments[1] : arguments[2];
    case Function::logarithm_or_zero:
      return protected_logarithm(a);
    case Function::bounded_exponential:
      return bounded_exponential(a);
    case Function::arc_tangent:
      return arc_tangent(a);
    case Function::square:
      return a * a;
    case Function::lesser:
      return lesser_of(a, arguments[1]);
    case Function::greater:
      return greater_of(a, arguments[1]);
    case Function::formula:
      break;
  }
  DEMECAL_CHECK(false, "an evolved formula has its own values");
}

std::optional<Expression> folded(Function function, const std::vector<Expression>& arguments) {
  const Expression first = arguments[0];
  Algebra& algebra = first.algebra();
  const bool trigonometric = function == Function::sine || function == Function::cosine;  // exact elsewhere
  if (!trigonometric && std::ranges::all_of(arguments, [](Expression argument) { return argument.is_constant(); })) {
    std::vector<double> values;
    for (const Expression argument : arguments) values.push_back(argument->value);
    const double value = value_of(function, values);
    if (std::isfinite(value)) return algebra.constant(value);
  }
  switch (function) {
    case Function::minimum:
    case Function::maximum:
    case Function::lesser:
    case Function::greater:
      if (first == arguments[1]) return first;
      break;
    case Function::if_not_negative:
      if (arguments[1] == arguments[2]) return arguments[1];
      if (first.is_constant()) return first->value >= 0.0 ? arguments[1] : arguments[2];
      break;
    case Function::divide_or_one:
      if (first == arguments[1]) return algebra.constant(1.0);
      [[fallthrough]];
    case Function::divide_or_zero:
      if (function == Function::divide_or_zero && first.is(0.0)) return first;
      if (arguments[1].is_constant() && !arguments[1].is(0.0)) return first / arguments[1];
      if (arguments[1].is(0.0)) return algebra.constant(function == Function::divide_or_one ? 1.0 : 0.0);
      break;
    default:
      break;
  }
  return std::nullopt;
}

}  // namespace demecal
