#include "symbolic/algebra.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "errors/check.hpp"
#include "symbolic/rules.hpp"

namespace demecal::inline symbolic {
namespace {

/// Gathers what stands by equal expressions, in the order of their ids; what comes to nothing goes.
class TermCollector {
 public:
  void add(Expression expression, double amount) {
    const auto [at, is_new] = amounts_.try_emplace(expression->id, expression, 0.0);
    at->second.second += amount;
  }
  std::vector<Part> parts() const {
    std::vector<Part> parts;
    for (const auto& [id, part] : amounts_) {
      if (part.second != 0.0) parts.push_back(part);
    }
    return parts;
  }

 private:
  std::map<std::uint32_t, Part> amounts_;
};

bool is_scaled(const ExpressionNode& term) {
  return term.kind == ExpressionKind::sum && term.value == 0.0 && term.parts.size() == 1;
}

/// Adds coefficient * expression to a sum that is being collector. Sums within are opened only where that multiplies
/// nothing out.
void collect_term(TermCollector& collector, double& constant, Expression expression, double coefficient) {
  const ExpressionNode& term = *expression;
  if (term.kind == ExpressionKind::constant) {
    constant += coefficient * term.value;
  } else if (term.kind == ExpressionKind::sum && (std::abs(coefficient) == 1.0 || is_scaled(term))) {
    constant += coefficient * term.value;
    for (const auto& [part, inner] : term.parts) collect_term(collector, constant, part, coefficient * inner);
  } else {
    collector.add(expression, coefficient);
  }
}

/// Sums of more parts are left as they are: every part would have to be held against every other, again and again.
constexpr std::size_t kMostJoined = 64;

/// Joins the first two parts that a theorem makes one of; whether there were any.
bool join_two(std::vector<Part>& parts) {
  if (parts.size() > kMostJoined) return false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (std::abs(parts[i].second) != std::abs(parts[j].second)) continue;
      const auto one = joined(parts[i].first, parts[j].first, parts[i].second * parts[j].second > 0.0 ? 1.0 : -1.0);
      if (!one) continue;
      parts[i].first = *one;
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

bool join_with_constant(std::vector<Part>& parts, double& constant) {
  for (Part& part : parts) {
    if (constant == 0.0 || std::abs(part.second) != std::abs(constant)) continue;
    const auto one = combined_with_one(part.first, part.second * constant > 0.0 ? 1.0 : -1.0);
    if (!one) continue;
    part = {*one, constant};
    constant = 0.0;
    return true;
  }
  return false;
}

/// base ^ exponent into a product that is being collector.
void collect_factor(TermCollector& collector, double& coefficient, Expression base, double exponent) {
  const ExpressionNode& term = *base;
  if (term.kind == ExpressionKind::constant) {
    coefficient *= std::pow(term.value, exponent);
  } else if (is_scaled(term)) {
    coefficient *= std::pow(term.parts[0].second, exponent);
    collect_factor(collector, coefficient, term.parts[0].first, exponent);
  } else if (term.kind == ExpressionKind::product) {
    for (const auto& [inner, power] : term.parts) collector.add(inner, power * exponent);
  } else {
    collector.add(base, exponent);
  }
}

}  // namespace

bool Expression::is_constant() const {
  return term_->kind == ExpressionKind::constant;
}
bool Expression::is(double constant) const {
  return is_constant() && term_->value == constant;
}
Algebra& Expression::algebra() const {
  return *term_->algebra;
}

Expression Algebra::interned(ExpressionKind kind, Function function, double value, const std::string& name,
                             std::vector<Part> parts) {
  value += 0.0;  // no -0
  Key key{kind, function, std::bit_cast<std::uint64_t>(value), name, {}};
  for (const auto& [part, amount] : parts)
    std::get<4>(key).emplace_back(part->id, std::bit_cast<std::uint64_t>(amount));
  const auto found = known_.find(key);
  if (found != known_.end()) return Expression(found->second);
  const auto id = static_cast<std::uint32_t>(terms_.size());
  terms_.push_back({this, id, kind, function, value, name, std::move(parts)});
  known_.emplace(std::move(key), &terms_.back());
  return Expression(&terms_.back());
}

Expression Algebra::constant(double value) {
  return interned(ExpressionKind::constant, {}, value, "", {});
}

Expression Algebra::symbol(const std::string& name) {
  return interned(ExpressionKind::symbol, {}, 0.0, name, {});
}

Expression Algebra::sum(std::vector<Part> parts, double constant) {
  while (true) {
    TermCollector collector;
    for (const auto& [part, coefficient] : parts) collect_term(collector, constant, part, coefficient);
    parts = collector.parts();
    if (!join_two(parts) && !join_with_constant(parts, constant)) break;
  }
  if (parts.empty()) return this->constant(constant);
  if (parts.size() == 1 && constant == 0.0 && parts[0].second == 1.0) return parts[0].first;
  return interned(ExpressionKind::sum, {}, constant, "", std::move(parts));
}

Expression Algebra::product(const std::vector<Part>& parts) {
  double coefficient = 1.0;
  TermCollector collector;
  for (const auto& [base, exponent] : parts) collect_factor(collector, coefficient, base, exponent);
  if (coefficient == 0.0) return constant(0.0);
  std::vector<Part> factors = collector.parts();
  if (factors.empty()) return constant(coefficient);
  const bool single = factors.size() == 1 && factors[0].second == 1.0;
  const Expression whole =
      single ? factors[0].first : interned(ExpressionKind::product, {}, 0.0, "", std::move(factors));
  return coefficient == 1.0 ? whole : sum({{whole, coefficient}});
}

Expression Algebra::function(Function function, const std::vector<Expression>& arguments) {
  DEMECAL_CHECK(function != Function::formula && !arguments.empty(), arguments.size() << " arguments");
  if (const auto value = folded(function, arguments)) return *value;
  if (function == Function::sine || function == Function::cosine) {
    if (const auto shorter = simplified_trigonometric(function, arguments[0])) return *shorter;
  }
  std::vector<Part> parts;
  for (const Expression argument : arguments) parts.emplace_back(argument, 1.0);
  return interned(ExpressionKind::function, function, 0.0, "", std::move(parts));
}

Expression Algebra::formula(const std::string& name, const Tree& tree, const std::vector<Expression>& arguments) {
  DEMECAL_CHECK(is_valid(tree, static_cast<int>(arguments.size())), name << ": " << tree.size() << " nodes");
  const auto [known, is_new] = trees_.try_emplace(name, tree);
  DEMECAL_CHECK(known->second == tree, "two formulas are called " << name);
  std::vector<Part> parts;
  for (const Expression argument : arguments) parts.emplace_back(argument, 1.0);
  return interned(ExpressionKind::function, Function::formula, 0.0, name, std::move(parts));
}

const Tree& Algebra::tree_of(const std::string& name) const {
  const auto found = trees_.find(name);
  DEMECAL_CHECK(found != trees_.end(), "no formula is called " << name);
  return found->second;
}

Expression operator+(Expression a, Expression b) {
  return a.algebra().sum({{a, 1.0}, {b, 1.0}});
}
Expression operator-(Expression a, Expression b) {
  return a.algebra().sum({{a, 1.0}, {b, -1.0}});
}
Expression operator*(Expression a, Expression b) {
  return a.algebra().product({{a, 1.0}, {b, 1.0}});
}
Expression operator/(Expression a, Expression b) {
  return a.algebra().product({{a, 1.0}, {b, -1.0}});
}
Expression operator-(Expression a) {
  return a.algebra().sum({{a, -1.0}});
}
Expression operator+(Expression a, double b) {
  return a.algebra().sum({{a, 1.0}}, b);
}
Expression operator-(Expression a, double b) {
  return a + -b;
}
Expression operator-(double a, Expression b) {
  return b.algebra().sum({{b, -1.0}}, a);
}
Expression operator*(double a, Expression b) {
  return b.algebra().constant(a) * b;
}

Expression sine(Expression angle) {
  return angle.algebra().function(Function::sine, {angle});
}
Expression cosine(Expression angle) {
  return angle.algebra().function(Function::cosine, {angle});
}
Expression square_root(Expression a) {
  return a.algebra().function(Function::square_root, {a});
}
Expression smaller(Expression a, Expression b) {
  return a.algebra().function(Function::minimum, {a, b});
}
Expression larger(Expression a, Expression b) {
  return a.algebra().function(Function::maximum, {a, b});
}

}  // namespace demecal::inline symbolic
