// Algebra with names: expressions of symbols whose equal parts are one, kept in a short form as they are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "expression/tree.hpp"

namespace demecal::inline symbolic {

enum class ExpressionKind { constant, symbol, sum, product, function };

/// What sums and products cannot say. `divide_or_one` is the protected division of evolved formulas, `divide_or_zero`
/// gives 0 where the divisor is 0, `round` goes away from zero at halves, `if_not_negative(c, a, b)` is a where c >= 0
/// and b elsewhere; `logarithm_or_zero`, `bounded_exponential`, `square`, `lesser` and `greater` are those of evolved
/// formulas; `formula` is an evolved formula, whose steps and their order stay as they are.
enum class Function {
  sine,
  cosine,
  hyperbolic_tangent,
  sign,
  absolute,
  square_root,
  round,
  minimum,
  maximum,
  divide_or_one,
  divide_or_zero,
  if_not_negative,
  logarithm_or_zero,
  bounded_exponential,
  arc_tangent,
  square,
  lesser,
  greater,
  formula
};

class Algebra;
struct ExpressionNode;

/// An expression of an algebra, which must outlive it. Equal expressions are the same term.
class Expression {
 public:
  explicit Expression(const ExpressionNode* term) : term_(term) {}

  const ExpressionNode& operator*() const { return *term_; }
  const ExpressionNode* operator->() const { return term_; }
  bool operator==(const Expression& other) const = default;
  bool is(double constant) const;
  bool is_constant() const;
  Algebra& algebra() const;

 private:
  const ExpressionNode* term_;
};

/// Of a sum: an expression and its coefficient; of a product: and its whole exponent; of a function: an argument.
using Part = std::pair<Expression, double>;

/// sum: value + coefficient * part + ...; product: part ^ exponent * ...; parts stand in the order they were first
/// made.
struct ExpressionNode {
  Algebra* algebra;
  std::uint32_t id;
  ExpressionKind kind;
  Function function;
  double value;      ///< of a constant, and the constant of a sum
  std::string name;  ///< of a symbol or an evolved formula
  std::vector<Part> parts;
};

/// Makes expressions, each once. They are held simple: like terms and like factors are gathered, what is constant is a
/// number, sines and cosines of right angles are exact, and so are sin^2 + cos^2 = 1 and the sums of angles wherever
/// two terms of a sum show them. Quotients are plain: x / x is 1, whatever x.
class Algebra {
 public:
  Algebra() = default;
  ~Algebra() = default;
  Algebra(const Algebra&) = delete;
  Algebra& operator=(const Algebra&) = delete;

  Expression constant(double value);
  Expression symbol(const std::string& name);
  /// constant + sum of coefficient * part.
  Expression sum(std::vector<Part> parts, double constant = 0.0);
  /// Product of part ^ exponent, exponents whole.
  Expression product(const std::vector<Part>& parts);
  Expression function(Function function, const std::vector<Expression>& arguments);
  /// The evolved formula at arguments that stand for its variables in their order. One name stands for one formula.
  Expression formula(const std::string& name, const Tree& tree, const std::vector<Expression>& arguments);

  /// The evolved formula of that name.
  const Tree& tree_of(const std::string& name) const;
  /// How many expressions there are; their ids are below it.
  std::size_t size() const { return terms_.size(); }

 private:
  /// Numbers by their bits: what is no number has no place in an order.
  using Key = std::tuple<ExpressionKind, Function, std::uint64_t, std::string,
                         std::vector<std::pair<std::uint32_t, std::uint64_t>>>;

  Expression interned(ExpressionKind kind, Function function, double value, const std::string& name,
                      std::vector<Part> parts);

  std::deque<ExpressionNode> terms_;
  std::map<Key, const ExpressionNode*> known_;
  std::map<std::string, Tree> trees_;
};

Expression operator+(Expression a, Expression b);
Expression operator-(Expression a, Expression b);
Expression operator*(Expression a, Expression b);
Expression operator/(Expression a, Expression b);
Expression operator-(Expression a);
Expression operator+(Expression a, double b);
Expression operator-(Expression a, double b);
Expression operator-(double a, Expression b);
Expression operator*(double a, Expression b);

Expression sine(Expression angle);
Expression cosine(Expression angle);
Expression square_root(Expression a);
Expression smaller(Expression a, Expression b);
Expression larger(Expression a, Expression b);

}  // namespace demecal::inline symbolic
