#include "expression/simplify.hpp"

#include <algorithm>
#include <cmath>

#include "expression/evaluate.hpp"
#include "expression/fold.hpp"
#include "expression/linear_form.hpp"

namespace demecal {
namespace {

bool is_constant(const Tree& tree) {
  return tree.front().primitive == Primitive::constant;
}
bool is(const Tree& tree, double constant) {
  return is_constant(tree) && tree.front().value == constant;
}
bool is(const Tree& tree, Primitive function) {
  return tree.front().primitive == function;
}
bool is_square(const Tree& tree) {
  if (!is(tree, Primitive::multiply)) return false;
  const auto second = tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, 1));
  return Tree(tree.begin() + 1, second) == Tree(second, tree.end());
}
bool is_never_negative(const Tree& tree) {
  return is(tree, Primitive::absolute) || is(tree, Primitive::square_root) || is(tree, Primitive::square) ||
         is(tree, Primitive::exponential) || is_square(tree);
}

Tree sum(Tree a, Tree b) {
  if (is(a, 0.0)) return b;
  if (is(b, 0.0)) return a;
  if (a == b && a.size() > 1) return apply(Primitive::multiply, constant_tree(2.0), a);
  return apply(Primitive::add, a, b);
}

Tree difference(Tree a, Tree b) {
  if (a == b) return constant_tree(0.0);
  if (is(b, 0.0)) return a;
  return apply(Primitive::subtract, a, b);
}

Tree product(Tree a, Tree b) {
  if (is(a, 0.0) || is(b, 0.0)) return constant_tree(0.0);
  if (is(a, 1.0)) return b;
  if (is(b, 1.0)) return a;
  return apply(Primitive::multiply, a, b);
}

Tree quotient(Tree a, Tree b) {
  if (a == b || is(b, 0.0)) return constant_tree(1.0);
  if (is(b, 1.0)) return a;
  return apply(Primitive::divide, a, b);
}

Tree joined(Primitive function, Tree a, Tree b) {
  if (is_constant(a) && is_constant(b)) {
    const double value = value_of(function, a.front().value, b.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  switch (function) {
    case Primitive::add:
      return sum(std::move(a), std::move(b));
    case Primitive::subtract:
      return difference(std::move(a), std::move(b));
    case Primitive::multiply:
      return product(std::move(a), std::move(b));
    case Primitive::divide:
      return quotient(std::move(a), std::move(b));
    default:
      return a == b ? a : apply(function, a, b);
  }
}

Tree called(Primitive function, Tree a) {
  if (is_constant(a)) {
    const double value = value_of(function, a.front().value);
    if (std::isfinite(value)) return constant_tree(value);
  }
  if (function == Primitive::absolute && is_never_negative(a)) return a;
  const bool takes_sizes =
      function == Primitive::square_root || function == Primitive::logarithm || function == Primitive::square;
  if (takes_sizes && is(a, Primitive::absolute)) a.erase(a.begin());
  if (function == Primitive::sign && is(a, Primitive::sign)) return a;
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
      [](Primitive function, Tree argument) { return called(function, std::move(argument)); },
      [](Primitive function, Tree left, Tree right) { return joined(function, std::move(left), std::move(right)); });
}

Tree collected(const Tree& tree) {
  return fold<Tree>(
      tree, [](const Node& node) { return Tree{node}; },
      [](Primitive function, Tree argument) { return called(function, std::move(argument)); },
      [](Primitive function, Tree left, Tree right) {
        return shorter_by_terms(joined(function, std::move(left), std::move(right)));
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

}  // namespace demecal
