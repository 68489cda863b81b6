// A formula as a sum of terms with coefficients: how terms are collected.
#pragma once

#include <span>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

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

}  // namespace demecal
