#include "expression/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "expression/evaluate.hpp"
#include "expression/tree.hpp"
#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline expression {
namespace {

using Span = std::span<const Node>;

struct ArgumentPair {
  Span left, right;
};

ArgumentPair arguments_of(Span tree) {
  const std::size_t middle = subtree_end(tree, 1);
  return {tree.subspan(1, middle - 1), tree.subspan(middle)};
}

// The constant among a product's factors, and the others in their order.
void split_factors(Span tree, double& constant, std::vector<Span>& factors) {
  if (is_constant(tree)) {
    constant *= tree.front().value;
  } else if (tree.front().primitive == Primitive::multiply) {
    const auto [left, right] = arguments_of(tree);
    split_factors(left, constant, factors);
    split_factors(right, constant, factors);
  } else {
    factors.push_back(tree);
  }
}

// A sum that grows by terms of either sign.
class SignedSum {
 public:
  void add(double coefficient, const Tree& term) {
    const double shown = tree_.empty() ? coefficient : std::abs(coefficient);
    const Tree product = shown == 1.0 ? term : apply(Primitive::multiply, constant_tree(shown), term);
    if (tree_.empty())
      tree_ = product;
    else
      tree_ = apply(coefficient > 0.0 ? Primitive::add : Primitive::subtract, tree_, product);
  }
  void add(double constant) {
    if (constant == 0.0) return;
    if (tree_.empty())
      tree_ = constant_tree(constant);
    else
      tree_ = apply(constant > 0.0 ? Primitive::add : Primitive::subtract, tree_, constant_tree(std::abs(constant)));
  }
  Tree tree() && { return tree_.empty() ? constant_tree(0.0) : std::move(tree_); }

 private:
  Tree tree_;
};

/// constant + sum of coefficient * term, no two terms equal, in the order in which they stand first.
class LinearForm {
 public:
  /// Takes sums, differences, and products with and quotients by constants apart; what is left are terms, products of
  /// them without their constant factors.
  explicit LinearForm(std::span<const Node> tree) { add(tree, 1.0); }

  /// The sum written out, terms with coefficients of equal size in one parenthesis; terms that cancel are left out. The
  /// empty tree where a coefficient is not finite.
  Tree tree() const;

 private:
  struct Term {
    double coefficient = 0.0;
    Tree tree;
  };
  void add(std::span<const Node> tree, double factor);
  void add_product(std::span<const Node> tree, double factor);
  void add_term(Tree tree, double coefficient);

  double constant_ = 0.0;
  std::vector<Term> terms_;
};

void LinearForm::add(Span tree, double factor) {
  const Primitive function = tree.front().primitive;
  if (is_constant(tree)) {
    constant_ += factor * tree.front().value;
  } else if (function == Primitive::add || function == Primitive::subtract) {
    const auto [left, right] = arguments_of(tree);
    add(left, factor);
    add(right, function == Primitive::add ? factor : -factor);
  } else if (function == Primitive::multiply) {
    add_product(tree, factor);
  } else if (function == Primitive::divide) {
    const auto [left, right] = arguments_of(tree);
    if (is_constant(right) && right.front().value != 0.0)
      add(left, factor / right.front().value);
    else
      add_term({tree.begin(), tree.end()}, factor);
  } else {
    add_term({tree.begin(), tree.end()}, factor);
  }
}

void LinearForm::add_product(Span tree, double factor) {
  std::vector<Span> factors;
  split_factors(tree, factor, factors);
  if (factors.empty()) {
    constant_ += factor;
  } else if (factors.size() == 1) {
    add(factors.front(), factor);
  } else {
    Tree product(factors.front().begin(), factors.front().end());
    for (std::size_t i = 1; i < factors.size(); ++i)
      product = apply(Primitive::multiply, product, Tree(factors[i].begin(), factors[i].end()));
    add_term(std::move(product), factor);
  }
}

void LinearForm::add_term(Tree tree, double coefficient) {
  const auto same = std::find_if(terms_.begin(), terms_.end(), [&](const Term& term) { return term.tree == tree; });
  if (same != terms_.end())
    same->coefficient += coefficient;
  else
    terms_.push_back({coefficient, std::move(tree)});
}

Tree LinearForm::tree() const {
  std::vector<Term> parts;  // sums of terms whose coefficients are of equal size, times that of the first
  for (const Term& term : terms_) {
    if (!std::isfinite(term.coefficient)) return {};
    if (term.coefficient == 0.0) continue;
    const auto alike = std::find_if(parts.begin(), parts.end(), [&](const Term& part) {
      return std::abs(part.coefficient) == std::abs(term.coefficient);
    });
    if (alike == parts.end())
      parts.push_back(term);
    else
      alike->tree =
          apply(alike->coefficient == term.coefficient ? Primitive::add : Primitive::subtract, alike->tree, term.tree);
  }
  if (!std::isfinite(constant_)) return {};
  // What is added comes before what is taken away, lest the first need a sign of its own.
  const auto is_added = [](const Term& part) { return part.coefficient > 0.0; };
  std::stable_partition(parts.begin(), parts.end(), is_added);
  const bool constant_first = !parts.empty() && !is_added(parts.front()) && constant_ > 0.0;
  SignedSum sum;
  if (constant_first) sum.add(constant_);
  for (const Term& part : parts) sum.add(part.coefficient, part.tree);
  if (!constant_first) sum.add(constant_);
  return std::move(sum).tree();
}

bool is_call_of(const Tree& tree, Primitive function) {
  return tree.front().primitive == function;
}
bool is_square_product(const Tree& tree) {
  if (!is_call_of(tree, Primitive::multiply)) return false;
  const auto second = tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, 1));
  return Tree(tree.begin() + 1, second) == Tree(second, tree.end());
}
bool is_never_negative(const Tree& tree) {
  return is_call_of(tree, Primitive::absolute) || is_call_of(tree, Primitive::square_root) ||
         is_call_of(tree, Primitive::square) || is_call_of(tree, Primitive::exponential) || is_square_product(tree);
}

Tree simple_sum(Tree a, Tree b) {
  if (is_constant(a, 0.0)) return b;
  if (is_constant(b, 0.0)) return a;
  if (a == b && a.size() > 1) return apply(Primitive::multiply, constant_tree(2.0), a);
  return apply(Primitive::add, a, b);
}

Tree simple_difference(Tree a, Tree b) {
  if (a == b) return constant_tree(0.0);
  if (is_constant(b, 0.0)) return a;
  return apply(Primitive::subtract, a, b);
}

Tree simple_product(Tree a, Tree b) {
  if (is_constant(a, 0.0) || is_constant(b, 0.0)) return constant_tree(0.0);
  if (is_constant(a, 1.0)) return b;
  if (is_constant(b, 1.0)) return a;
  return apply(Primitive::multiply, a, b);
}

Tree simple_quotient(Tree a, Tree b) {
  if (a == b || is_constant(b, 0.0)) return constant_tree(1.0);
  if (is_constant(b, 1.0)) return a;
  return apply(Primitive::divide, a, b);
}

Tree simple_binary(Primitive function, Tree a, Tree b) {
  if (is_constant(a) && is_constant(b)) {
    Tree whole = apply_folded(function, a, b);
    if (is_constant(whole)) return whole;
  }
  switch (function) {
    case Primitive::add:
      return simple_sum(std::move(a), std::move(b));
    case Primitive::subtract:
      return simple_difference(std::move(a), std::move(b));
    case Primitive::multiply:
      return simple_product(std::move(a), std::move(b));
    case Primitive::divide:
      return simple_quotient(std::move(a), std::move(b));
    default:
      return a == b ? a : apply(function, a, b);
  }
}

Tree simple_unary(Primitive function, Tree a) {
  if (is_constant(a)) return apply_folded(function, std::move(a));
  if (function == Primitive::absolute && is_never_negative(a)) return a;
  const bool takes_sizes =
      function == Primitive::square_root || function == Primitive::logarithm || function == Primitive::square;
  if (takes_sizes && is_call_of(a, Primitive::absolute)) a.erase(a.begin());
  if (function == Primitive::sign && is_call_of(a, Primitive::sign)) return a;
  return apply(function, std::move(a));
}

// Only a sum or a product can have terms to collect.
Tree shorter_by_terms(Tree tree) {
  switch (tree.front().primitive) {
    case Primitive::add:
    case Primitive::subtract:
    case Primitive::multiply:
    case Primitive::divide: {
      Tree linear = LinearForm(tree).tree();
      return !linear.empty() && linear.size() < tree.size() ? linear : tree;
    }
    default:
      return tree;
  }
}

}  // namespace

Tree simplified(const Tree& tree) {
  return fold<Tree>(
      tree, [](const Node& node) { return Tree{node}; },
      [](Primitive function, Tree argument) { return simple_unary(function, std::move(argument)); },
      [](Primitive function, Tree left, Tree right) {
        return simple_binary(function, std::move(left), std::move(right));
      });
}

Tree collected(const Tree& tree) {
  return fold<Tree>(
      tree, [](const Node& node) { return Tree{node}; },
      [](Primitive function, Tree argument) { return simple_unary(function, std::move(argument)); },
      [](Primitive function, Tree left, Tree right) {
        return shorter_by_terms(simple_binary(function, std::move(left), std::move(right)));
      });
}

Tree simplified_over(const Tree& tree, const std::vector<std::vector<double>>& columns, double tolerance) {
  Tree shorter = collected(tree);
  ColumnEvaluator evaluate(columns), evaluate_shorter(columns);
  const std::span<const double> values = evaluate(tree), shorter_values = evaluate_shorter(shorter);
  double largest = 0.0, furthest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest = std::max(largest, std::abs(values[i]));
    furthest = std::max(furthest, std::abs(values[i] - shorter_values[i]));
    if (!std::isfinite(values[i] - shorter_values[i])) return simplified(tree);
  }
  return furthest <= tolerance * largest ? shorter : simplified(tree);
}

}  // namespace demecal::inline expression
