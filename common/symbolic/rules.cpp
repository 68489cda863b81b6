#include "symbolic/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "errors/check.hpp"
#include "primitives/elementary.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline symbolic {

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

namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;
/// Angles of text and files are rounded: this near a multiple of a right angle (rad) they are meant to be it.
constexpr double kRightAngleRounding = 4e-16;

/// How many right angles a constant angle is, where it is a whole number of them.
std::optional<int> right_angles(double angle) {
  const double count = std::round(angle / kRightAngle);
  if (!(std::abs(count) <= 1000.0) ||
      std::abs(angle - count * kRightAngle) > kRightAngleRounding * std::max(1.0, std::abs(angle))) {
    return std::nullopt;
  }
  return (static_cast<int>(count) % 4 + 4) % 4;
}

/// The function of `angle` and so many right angles more, without them.
Expression less_right_angles(Function function, Expression angle, int count) {
  const int quarter = (count + (function == Function::cosine ? 1 : 0)) % 4;  // cos x = sin(x + pi/2)
  if (angle.is(0.0))
    return angle.algebra().constant(std::array{0.0, 1.0, 0.0, -1.0}[static_cast<std::size_t>(quarter)]);
  const Expression value = quarter % 2 == 0 ? sine(angle) : cosine(angle);
  return quarter < 2 ? value : -value;
}

/// Both products without the factors they share, and these.
struct SplitFactors {
  std::vector<Part> shared, first, second;
};

SplitFactors split_common_factors(Expression first, Expression second) {
  SplitFactors split;
  std::vector<Part> of_second = factors_of(second);
  for (const auto& [base, exponent] : factors_of(first)) {
    const auto same = std::ranges::find(of_second, base, &Part::first);
    const bool both = same != of_second.end() && same->second * exponent > 0.0;
    const double common = !both            ? 0.0
                          : exponent > 0.0 ? std::min(exponent, same->second)
                                           : std::max(exponent, same->second);
    if (both) same->second -= common;
    if (common != 0.0) split.shared.emplace_back(base, common);
    if (exponent != common) split.first.emplace_back(base, exponent - common);
  }
  for (const Part& part : of_second) {
    if (part.second != 0.0) split.second.push_back(part);
  }
  return split;
}

bool is_power_of(const Part& factor, Function function, double exponent) {
  return factor.first->kind == ExpressionKind::function && factor.first->function == function &&
         factor.second == exponent;
}
Expression angle_of(const Part& factor) {
  return factor.first->parts[0].first;
}

/// sin^2 a + cos^2 a, cos^2 a - sin^2 a, and 1 - sin^2 a (`first` empty).
std::optional<Expression> joined_squares(const std::vector<Part>& first, const std::vector<Part>& second, double ratio,
                                         Algebra& algebra) {
  if (second.size() != 1) return std::nullopt;
  const bool sine_second = is_power_of(second[0], Function::sine, 2.0),
             cosine_second = is_power_of(second[0], Function::cosine, 2.0);
  if (!sine_second && !cosine_second) return std::nullopt;
  const Expression angle = angle_of(second[0]);
  if (first.empty() && ratio < 0.0) {
    const Expression other = sine_second ? cosine(angle) : sine(angle);
    return other * other;
  }
  if (first.size() != 1 || !is_power_of(first[0], sine_second ? Function::cosine : Function::sine, 2.0))
    return std::nullopt;
  if (angle_of(first[0]) != angle) return std::nullopt;
  if (ratio > 0.0) return algebra.constant(1.0);
  return sine_second ? cosine(2.0 * angle) : -cosine(2.0 * angle);
}

/// Two factors, each of first power: of which function, of which angle; sines first.
std::optional<std::array<Part, 2>> pair_of(const std::vector<Part>& factors) {
  if (factors.size() != 2) return std::nullopt;
  for (const Part& factor : factors) {
    if (!is_power_of(factor, Function::sine, 1.0) && !is_power_of(factor, Function::cosine, 1.0)) return std::nullopt;
  }
  std::array<Part, 2> pair{factors[0], factors[1]};
  if (is_power_of(pair[0], Function::cosine, 1.0) && is_power_of(pair[1], Function::sine, 1.0))
    std::swap(pair[0], pair[1]);
  return pair;
}

/// cos a cos b -+ sin a sin b and sin a cos b +- cos a sin b.
std::optional<Expression> joined_angles(const std::vector<Part>& first, const std::vector<Part>& second, double ratio) {
  const auto one = pair_of(first), other = pair_of(second);
  if (!one || !other) return std::nullopt;
  const Expression a = angle_of((*one)[0]), b = angle_of((*one)[1]);
  const Expression c = angle_of((*other)[0]), d = angle_of((*other)[1]);
  const bool mixed_one = (*one)[0].first->function != (*one)[1].first->function;
  const bool mixed_other = (*other)[0].first->function != (*other)[1].first->function;
  if (mixed_one && mixed_other) {
    if (a != d || b != c) return std::nullopt;  // sin a cos b + ratio sin b cos a
    return sine(a + ratio * b);
  }
  if (mixed_one || mixed_other || (*one)[0].first->function == (*other)[0].first->function) return std::nullopt;
  if (!((a == c && b == d) || (a == d && b == c))) return std::nullopt;
  const bool cosines_first = (*one)[0].first->function == Function::cosine;
  const Expression value = cosine(a - ratio * b);  // cos a cos b + ratio sin a sin b
  return cosines_first || ratio > 0.0 ? value : -value;
}

}  // namespace

std::vector<Part> factors_of(Expression expression) {
  if (expression->kind == ExpressionKind::product) return expression->parts;
  if (expression.is(1.0)) return {};
  return {{expression, 1.0}};
}

std::optional<Expression> simplified_trigonometric(Function function, Expression angle) {
  Algebra& algebra = angle.algebra();
  if (angle.is_constant()) {
    const auto count = right_angles(angle->value);
    if (count) return less_right_angles(function, algebra.constant(0.0), *count);
    return algebra.constant(function == Function::sine ? std::sin(angle->value) : std::cos(angle->value));
  }
  if (angle->kind != ExpressionKind::sum) return std::nullopt;
  const auto count = right_angles(angle->value);
  if (angle->value != 0.0 && count) return less_right_angles(function, angle - angle->value, *count);
  if (angle->parts[0].second > 0.0) return std::nullopt;
  return function == Function::sine ? -sine(-angle) : cosine(-angle);
}

std::optional<Expression> joined(Expression first, Expression second, double ratio) {
  const SplitFactors both = split_common_factors(first, second);
  Algebra& algebra = first.algebra();
  std::optional<Expression> value = joined_squares(both.first, both.second, ratio, algebra);
  if (!value && ratio > 0.0) value = joined_squares(both.second, both.first, ratio, algebra);
  if (!value && ratio < 0.0) {
    value = joined_squares(both.second, both.first, ratio, algebra);
    if (value) value = -*value;
  }
  if (!value) value = joined_angles(both.first, both.second, ratio);
  if (!value) return std::nullopt;
  std::vector<Part> factors = both.shared;
  factors.emplace_back(*value, 1.0);
  return algebra.product(factors);
}

std::optional<Expression> combined_with_one(Expression term, double ratio) {
  return joined_squares({}, factors_of(term), ratio, term.algebra());
}

}  // namespace demecal::inline symbolic
