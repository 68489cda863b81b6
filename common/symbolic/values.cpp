#include "symbolic/values.hpp"

#include <cmath>

#include "errors/check.hpp"
#include "expression/evaluate.hpp"
#include "symbolic/fold_constants.hpp"

namespace demecal {
namespace {

double at(const ExpressionNode& term, const SymbolValues& symbols, const std::map<std::uint32_t, double>& known) {
  if (term.kind == Kind::constant) return term.value;
  if (term.kind == Kind::symbol) {
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
  if (term.kind == Kind::sum) return sum;
  if (term.kind == Kind::product) return product;
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
  for (const Expression term : terms_of(expressions)) known[term->id] = at(*term, symbols, known);
  std::vector<double> values;
  for (const Expression expression : expressions) values.push_back(known.at(expression->id));
  return values;
}

double value_of(Expression expression, const SymbolValues& symbols) {
  return values_of({&expression, 1}, symbols)[0];
}

}  // namespace demecal
