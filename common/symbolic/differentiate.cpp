#include "symbolic/differentiate.hpp"

#include <map>

#include "expression/differentiate.hpp"
#include "expression/exponential.hpp"
#include "expression/simplify.hpp"

namespace demecal {
namespace {

Expression called(Function function, const std::vector<Expression>& arguments) {
  return arguments[0].algebra().function(function, arguments);
}

class Differentiation {
 public:
  explicit Differentiation(Expression symbol) : symbol_(symbol), algebra_(symbol.algebra()) {}

  Expression operator()(Expression expression) {
    const auto known = known_.find(expression->id);
    if (known != known_.end()) return known->second;
    const Expression value = of(expression);
    known_.emplace(expression->id, value);
    return value;
  }

 private:
  Expression of(Expression expression) {
    switch (expression->kind) {
      case Kind::constant:
        return algebra_.constant(0.0);
      case Kind::symbol:
        return algebra_.constant(expression == symbol_ ? 1.0 : 0.0);
      case Kind::sum: {
        std::vector<Part> parts;
        for (const auto& [part, coefficient] : expression->parts) parts.emplace_back((*this)(part), coefficient);
        return algebra_.sum(parts);
      }
      case Kind::product:
        return of_product(expression->parts);
      case Kind::function:
        break;
    }
    return expression->function == Function::formula ? of_formula(expression) : of_function(expression);
  }

  Expression of_product(const std::vector<Part>& factors) {
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
  Expression of_formula(Expression expression) {
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

  Expression of_function(Expression expression) {
    std::vector<Expression> at, by;
    for (const Part& part : expression->parts) {
      at.push_back(part.first);
      by.push_back((*this)(part.first));
    }
    switch (expression->function) {
      case Function::sine:
        return cosine(at[0]) * by[0];
      case Function::cosine:
        return -sine(at[0]) * by[0];
      case Function::hyperbolic_tangent:
        return (1.0 - expression * expression) * by[0];
      case Function::absolute:
        return called(Function::sign, at) * by[0];
      case Function::square_root:
        return called(Function::divide_or_zero, {0.5 * by[0], expression});
      case Function::logarithm_or_zero:
        return called(Function::divide_or_zero, {by[0], at[0]});
      case Function::bounded_exponential: {
        const Expression room = kLargestExponent - called(Function::absolute, at);
        return 0.5 * (called(Function::sign, {room}) + 1.0) * expression * by[0];
      }
      case Function::arc_tangent:
        return by[0] / (at[0] * at[0] + 1.0);
      case Function::square:
        return 2.0 * at[0] * by[0];
      case Function::lesser:
      case Function::minimum:
        return chosen(at[1] - at[0], by);
      case Function::greater:
      case Function::maximum:
        return chosen(at[0] - at[1], by);
      case Function::divide_or_one:
      case Function::divide_or_zero:
        return called(Function::divide_or_zero, {by[0] * at[1] - at[0] * by[1], at[1] * at[1]});
      case Function::if_not_negative:
        return called(Function::if_not_negative, {at[0], by[1], by[2]});
      default:
        return algebra_.constant(0.0);  // sign, round: steps
    }
  }

  /// The first of two slopes where `first_if` is positive, their mean where it is 0.
  static Expression chosen(Expression first_if, const std::vector<Expression>& by) {
    const Expression side = called(Function::sign, {first_if});
    return 0.5 * (by[0] + by[1]) + 0.5 * side * (by[0] - by[1]);
  }

  Expression symbol_;
  Algebra& algebra_;
  std::map<std::uint32_t, Expression> known_;
};

}  // namespace

Expression derivative(Expression expression, const std::string& symbol) {
  return Differentiation(expression.algebra().symbol(symbol))(expression);
}

}  // namespace demecal
