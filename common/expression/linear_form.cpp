#include "expression/linear_form.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace demecal {
namespace {

using Span = std::span<const Node>;

struct Arguments {
  Span left, right;
};

Arguments arguments_of(Span tree) {
  const std::size_t middle = subtree_end(tree, 1);
  return {tree.subspan(1, middle - 1), tree.subspan(middle)};
}

bool is_number(Span tree) {
  return tree.size() == 1 && tree.front().primitive == Primitive::constant;
}

// The constant among a product's factors, and the others in their order.
void take_apart(Span tree, double& constant, std::vector<Span>& factors) {
  if (is_number(tree)) {
    constant *= tree.front().value;
  } else if (tree.front().primitive == Primitive::multiply) {
    const auto [left, right] = arguments_of(tree);
    take_apart(left, constant, factors);
    take_apart(right, constant, factors);
  } else {
    factors.push_back(tree);
  }
}

// A sum that grows by terms of either sign.
class Sum {
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

}  // namespace

void LinearForm::add(Span tree, double factor) {
  const Primitive function = tree.front().primitive;
  if (is_number(tree)) {
    constant_ += factor * tree.front().value;
  } else if (function == Primitive::add || function == Primitive::subtract) {
    const auto [left, right] = arguments_of(tree);
    add(left, factor);
    add(right, function == Primitive::add ? factor : -factor);
  } else if (function == Primitive::multiply) {
    add_product(tree, factor);
  } else if (function == Primitive::divide) {
    const auto [left, right] = arguments_of(tree);
    if (is_number(right) && right.front().value != 0.0)
      add(left, factor / right.front().value);
    else
      add_term({tree.begin(), tree.end()}, factor);
  } else {
    add_term({tree.begin(), tree.end()}, factor);
  }
}

void LinearForm::add_product(Span tree, double factor) {
  std::vector<Span> factors;
  take_apart(tree, factor, factors);
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
  Sum sum;
  if (constant_first) sum.add(constant_);
  for (const Term& part : parts) sum.add(part.coefficient, part.tree);
  if (!constant_first) sum.add(constant_);
  return std::move(sum).tree();
}

}  // namespace demecal
