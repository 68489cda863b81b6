#include "symbolic/calculus.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "errors/check.hpp"
#include "expression/evaluate.hpp"
#include "expression/simplify.hpp"
#include "expression/tree.hpp"
#include "primitives/elementary.hpp"
#include "symbolic/rules.hpp"

namespace demecal::inline symbolic {
namespace {

double term_value(const ExpressionNode& term, const SymbolValues& symbols,
                  const std::map<std::uint32_t, double>& known) {
  if (term.kind == ExpressionKind::constant) return term.value;
  if (term.kind == ExpressionKind::symbol) {
    const auto found = symbols.find(term.name);
    DEMECAL_CHECK(found != symbols.end(), "no value of " << term.name);
    return found->second;
  }
  std::vector<double> arguments;
  double sum = term.value, product = 1.0;
  for (const auto& [part, amount] : term.parts) {
    const double value = known.at(part->id);
    arguments.push_back(value);
    sum += amount * value;
    product *= amount == 1.0 ? value : std::pow(value, amount);
  }
  if (term.kind == ExpressionKind::sum) return sum;
  if (term.kind == ExpressionKind::product) return product;
  if (term.function == Function::formula) return evaluate(term.algebra->tree_of(term.name), arguments);
  return value_of(term.function, arguments);
}

}  // namespace

std::vector<Expression> terms_of(std::span<const Expression> expressions) {
  std::map<std::uint32_t, Expression> found;
  std::vector<Expression> open(expressions.begin(), expressions.end());
  while (!open.empty()) {
    const Expression next = open.back();
    open.pop_back();
    if (!found.emplace(next->id, next).second) continue;
    for (const Part& part : next->parts) open.push_back(part.first);
  }
  std::vector<Expression> terms;  // a part is made before what it is part of
  for (const auto& [id, expression] : found) terms.push_back(expression);
  return terms;
}

std::vector<double> values_of(std::span<const Expression> expressions, const SymbolValues& symbols) {
  std::map<std::uint32_t, double> known;
  for (const Expression term : terms_of(expressions)) known[term->id] = term_value(*term, symbols, known);
  std::vector<double> values;
  for (const Expression expression : expressions) values.push_back(known.at(expression->id));
  return values;
}

double value_of(Expression expression, const SymbolValues& symbols) {
  return values_of({&expression, 1}, symbols)[0];
}

namespace {

Expression call(Function function, const std::vector<Expression>& arguments) {
  return arguments[0].algebra().function(function, arguments);
}

class Differentiation {
 public:
  explicit Differentiation(Expression symbol) : symbol_(symbol), algebra_(symbol.algebra()) {}

  Expression operator()(Expression expression) {
    const auto known = known_.find(expression->id);
    if (known != known_.end()) return known->second;
    const Expression value = derived(expression);
    known_.emplace(expression->id, value);
    return value;
  }

 private:
  Expression derived(Expression expression) {
    switch (expression->kind) {
      case ExpressionKind::constant:
        return algebra_.constant(0.0);
      case ExpressionKind::symbol:
        return algebra_.constant(expression == symbol_ ? 1.0 : 0.0);
      case ExpressionKind::sum: {
        std::vector<Part> parts;
        for (const auto& [part, coefficient] : expression->parts) parts.emplace_back((*this)(part), coefficient);
        return algebra_.sum(parts);
      }
      case ExpressionKind::product:
        return derived_product(expression->parts);
      case ExpressionKind::function:
        break;
    }
    return expression->function == Function::formula ? derived_formula(expression) : derived_function(expression);
  }

  Expression derived_product(const std::vector<Part>& factors) {
    std::vector<Part> sum;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      std::vector<Part> term = factors;
      term[i].second -= 1.0;
      term.emplace_back((*this)(factors[i].first), 1.0);
      sum.emplace_back(algebra_.product(term), factors[i].second);
    }
    return algebra_.sum(sum);
  }

  /// Sum over the formula's variables of its slope times theirs.
  Expression derived_formula(Expression expression) {
    std::vector<Expression> arguments;
    for (const Part& part : expression->parts) arguments.push_back(part.first);
    std::vector<Part> sum;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Expression inner = (*this)(arguments[i]);
      if (inner.is(0.0)) continue;
      const Tree slope = simplified(derivative(algebra_.tree_of(expression->name), static_cast<std::uint8_t>(i)));
      sum.emplace_back(algebra_.formula(expression->name + "_slope" + std::to_string(i + 1), slope, arguments) * inner,
                       1.0);
    }
    return algebra_.sum(sum);
  }

  Expression derived_function(Expression expression) {
    std::vector<Expression> args, slopes;
    for (const Part& part : expression->parts) {
      args.push_back(part.first);
      slopes.push_back((*this)(part.first));
    }
    switch (expression->function) {
      case Function::sine:
        return cosine(args[0]) * slopes[0];
      case Function::cosine:
        return -sine(args[0]) * slopes[0];
      case Function::hyperbolic_tangent:
        return (1.0 - expression * expression) * slopes[0];
      case Function::absolute:
        return call(Function::sign, args) * slopes[0];
      case Function::square_root:
        return call(Function::divide_or_zero, {0.5 * slopes[0], expression});
      case Function::logarithm_or_zero:
        return call(Function::divide_or_zero, {slopes[0], args[0]});
      case Function::bounded_exponential: {
        const Expression room = kLargestExponent - call(Function::absolute, args);
        return 0.5 * (call(Function::sign, {room}) + 1.0) * expression * slopes[0];
      }
      case Function::arc_tangent:
        return slopes[0] / (args[0] * args[0] + 1.0);
      case Function::square:
        return 2.0 * args[0] * slopes[0];
      case Function::lesser:
      case Function::minimum:
        return chosen(args[1] - args[0], slopes);
      case Function::greater:
      case Function::maximum:
        return chosen(args[0] - args[1], slopes);
      case Function::divide_or_one:
      case Function::divide_or_zero:
        return call(Function::divide_or_zero, {slopes[0] * args[1] - args[0] * slopes[1], args[1] * args[1]});
      case Function::if_not_negative:
        return call(Function::if_not_negative, {args[0], slopes[1], slopes[2]});
      default:
        return algebra_.constant(0.0);  // sign, round: steps
    }
  }

  /// The first of two slopes where `first_if` is positive, their mean where it is 0.
  static Expression chosen(Expression first_if, const std::vector<Expression>& slopes) {
    const Expression side = call(Function::sign, {first_if});
    return 0.5 * (slopes[0] + slopes[1]) + 0.5 * side * (slopes[0] - slopes[1]);
  }

  Expression symbol_;
  Algebra& algebra_;
  std::map<std::uint32_t, Expression> known_;
};

}  // namespace

Expression derivative(Expression expression, const std::string& symbol) {
  return Differentiation(expression.algebra().symbol(symbol))(expression);
}

}  // namespace demecal::inline symbolic
