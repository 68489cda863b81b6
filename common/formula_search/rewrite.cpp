#include "formula_search/rewrite.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "fitting/levenberg_marquardt.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline formula_search {
namespace {

constexpr std::size_t kMostConstants = 8;
constexpr int kSteps = 30;
constexpr double kNearRound = 0.15;  ///< of a round number

std::vector<std::size_t> constants_of(const Tree& tree) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tree.size() && places.size() < kMostConstants; ++i) {
    if (tree[i].primitive == Primitive::constant) places.push_back(i);
  }
  return places;
}

/// Least squares over the constants of a formula at `places`, by differences.
class ConstantsProblem {
 public:
  ConstantsProblem(Tree tree, const std::vector<std::size_t>& places, FormulaMisfit& misfit)
      : tree_(std::move(tree)), places_(places), misfit_(misfit), residual_(misfit.residual(tree_)) {}

  const Tree& tree() const { return tree_; }

  std::optional<double> linearize(double& /*damping*/) {
    if (residual_.size() == 0 || places_.empty()) return std::nullopt;
    jacobian_.resize(residual_.size(), static_cast<Eigen::Index>(places_.size()));
    for (std::size_t k = 0; k < places_.size(); ++k) {
      Tree moved = tree_;
      double& constant = moved[places_[k]].value;
      const double by = 1e-6 * (1.0 + std::abs(constant));
      constant += by;
      const Eigen::VectorXd there = misfit_.residual(moved);
      if (there.size() == 0) return std::nullopt;
      jacobian_.col(static_cast<Eigen::Index>(k)) = (there - residual_) / by;
    }
    return residual_.squaredNorm();
  }

  std::optional<double> try_step(double damping) {
    Eigen::MatrixXd normal = jacobian_.transpose() * jacobian_;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd change = -PivotedCholesky(normal).solve(jacobian_.transpose() * residual_);
    tried_ = tree_;
    for (std::size_t k = 0; k < places_.size(); ++k) tried_[places_[k]].value += change[static_cast<Eigen::Index>(k)];
    tried_residual_ = misfit_.residual(tried_);
    if (tried_residual_.size() == 0) return std::nullopt;
    return tried_residual_.squaredNorm();
  }

  void accept() {
    tree_ = tried_;
    residual_ = tried_residual_;
  }

 private:
  Tree tree_, tried_;
  const std::vector<std::size_t>& places_;
  FormulaMisfit& misfit_;
  Eigen::VectorXd residual_, tried_residual_;
  Eigen::MatrixXd jacobian_;
};

Tree with_fitted_constants(Tree tree, const std::vector<std::size_t>& places, FormulaMisfit& misfit) {
  ConstantsProblem problem(std::move(tree), places, misfit);
  levenberg_marquardt(problem, {.max_iterations = kSteps, .initial_damping = 1e-3, .max_damping = 1e6});
  return problem.tree();
}

constexpr std::size_t kLongest = 20;  ///< nodes: longer formulas do not grow
constexpr std::size_t kPolished = 4;  ///< variants that are polished where none is better as it stands

struct Variant {
  Tree tree;
  double nats = 0.0;
};

Tree part(const Tree& tree, std::size_t begin) {
  return {tree.begin() + static_cast<std::ptrdiff_t>(begin),
          tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, begin))};
}

bool is_constant(const Tree& tree) {
  return std::ranges::none_of(tree, [](const Node& node) { return node.primitive == Primitive::variable; });
}

/// The formula but for a factor that is the same at all poses.
Tree without_amplitude(const Tree& tree) {
  if (tree[0].primitive != Primitive::multiply && tree[0].primitive != Primitive::divide) return tree;
  const Tree left = part(tree, 1), right = part(tree, subtree_end(tree, 1));
  if (is_constant(right)) return without_amplitude(left);
  const bool by_quotient = tree[0].primitive == Primitive::divide && right[0].primitive == Primitive::divide;
  if (by_quotient && is_constant(part(right, 1))) {  // x % (c % y) is x * y
    return without_amplitude(apply(Primitive::multiply, left, part(right, subtree_end(right, 1))));
  }
  if (is_constant(left) && tree[0].primitive == Primitive::multiply) return without_amplitude(right);
  return apply(tree[0].primitive, without_amplitude(left), without_amplitude(right));
}

Tree with_part(const Tree& tree, std::size_t begin, const Tree& instead) {
  Tree changed(tree.begin(), tree.begin() + static_cast<std::ptrdiff_t>(begin));
  changed.insert(changed.end(), instead.begin(), instead.end());
  changed.insert(changed.end(), tree.begin() + static_cast<std::ptrdiff_t>(subtree_end(tree, begin)), tree.end());
  return changed;
}

/// A variable, its sine and its cosine.
std::vector<Tree> elementary_functions(std::uint8_t variable) {
  const Tree itself = variable_tree(variable);
  return {itself, apply(Primitive::sine, itself), apply(Primitive::cosine, itself)};
}

/// The elementary functions of the only variable that a part depends on; none where it depends on several.
std::vector<Tree> elementary_forms(const Tree& tree) {
  const auto first = std::ranges::find(tree, Primitive::variable, &Node::primitive);
  if (first == tree.end()) return {};
  const auto is_other = [&](const Node& node) {
    return node.primitive == Primitive::variable && node.variable != first->variable;
  };
  if (std::ranges::any_of(tree, is_other)) return {};
  return elementary_functions(first->variable);
}

std::vector<Tree> elementary_factors(int variables) {
  std::vector<Tree> factors;
  for (int i = 0; i < variables; ++i) {
    for (Tree& factor : elementary_functions(static_cast<std::uint8_t>(i))) factors.push_back(std::move(factor));
  }
  return factors;
}

class Rewriting {
 public:
  explicit Rewriting(FormulaMisfit& misfit) : misfit_(misfit), factors_(elementary_factors(misfit.variables())) {}

  Tree run(const Tree& tree) {
    Variant best = priced(polished(without_amplitude(tree), misfit_));
    while (improve(best) || add_factors(best)) {
    }
    return std::move(best.tree);
  }

 private:
  Variant priced(Tree tree) {
    const double nats = misfit_.nats(tree) + description_nats(tree, misfit_.variables(), misfit_.poses());
    return {std::move(tree), nats};
  }

  std::vector<Variant> variants_of(const Tree& tree) {
    std::vector<Variant> variants;
    const auto offer = [&](std::size_t begin, const Tree& instead) {
      Tree changed = without_amplitude(with_part(tree, begin, instead));
      if (!is_constant(changed)) variants.push_back(priced(std::move(changed)));
    };
    if (tree.size() < kLongest) {
      for (const Tree& factor : factors_) offer(0, apply(Primitive::multiply, tree, factor));
    }
    for (std::size_t i = 0; i < tree.size(); ++i) {
      if (tree[i].primitive == Primitive::variable && tree.size() < kLongest) {
        for (const Tree& sum : sums_with(tree[i])) offer(i, sum);
      }
      if (tree[i].primitive != Primitive::constant && i > 0) offer(i, constant_tree(1.0));
      for (const Tree& elementary : elementary_forms(part(tree, i))) offer(i, elementary);
      for (std::size_t at = i + 1, k = 0; k < static_cast<std::size_t>(arity(tree[i].primitive)); ++k) {
        offer(i, part(tree, at));
        at = subtree_end(tree, at);
      }
    }
    std::ranges::stable_sort(variants, {}, &Variant::nats);
    return variants;
  }

  bool improve(Variant& best) {
    std::vector<Variant> variants = variants_of(best.tree);
    if (variants.empty()) return false;
    if (variants[0].nats < best.nats) {
      best = std::move(variants[0]);
      return true;
    }
    if (variants.size() > kPolished) variants.resize(kPolished);
    for (const Variant& variant : variants) {
      if (!std::isfinite(variant.nats)) break;
      Variant again = priced(polished(variant.tree, misfit_));
      if (!(again.nats < best.nats)) continue;
      best = std::move(again);
      return true;
    }
    Variant again = priced(polished(best.tree, misfit_));
    const bool better = again.nats < best.nats - 1e-9;
    if (better) best = std::move(again);
    return better;
  }

  /// By two factors at once: of a product of three, no two need show any of it.
  bool add_factors(Variant& best) {
    if (best.tree.size() >= kLongest) return false;
    Variant longest = best;
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      const Tree once = apply(Primitive::multiply, best.tree, factors_[i]);
      for (std::size_t k = i; k < factors_.size(); ++k) {
        Variant twice = priced(apply(Primitive::multiply, once, factors_[k]));
        if (twice.nats < longest.nats) longest = std::move(twice);
      }
    }
    const bool better = longest.nats < best.nats;
    best = std::move(longest);
    return better;
  }

  /// Twice the variable, and sums and differences of it with every other.
  std::vector<Tree> sums_with(const Node& variable) const {
    const Tree itself = variable_tree(variable.variable);
    std::vector<Tree> sums{apply(Primitive::multiply, constant_tree(2.0), itself)};
    for (int i = 0; i < misfit_.variables(); ++i) {
      const Tree other = variable_tree(static_cast<std::uint8_t>(i));
      if (other == itself) continue;
      sums.push_back(apply(Primitive::add, itself, other));
      sums.push_back(apply(Primitive::subtract, itself, other));
    }
    return sums;
  }

  FormulaMisfit& misfit_;
  std::vector<Tree> factors_;
};

}  // namespace

Tree polished(const Tree& tree, FormulaMisfit& misfit) {
  const double digits_nats = 0.5 * std::log(static_cast<double>(std::max<std::size_t>(misfit.poses(), 2)));
  std::vector<std::size_t> free = constants_of(tree);
  Tree best = with_fitted_constants(tree, free, misfit);
  for (std::size_t i = 0; i < free.size();) {
    const double value = best[free[i]].value, round = 0.5 * std::round(2.0 * value);
    if (std::abs(value - round) > kNearRound) {
      ++i;
      continue;
    }
    std::vector<std::size_t> others = free;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    Tree rounded = best;
    rounded[free[i]].value = round;
    rounded = with_fitted_constants(std::move(rounded), others, misfit);
    if (misfit.nats(rounded) - misfit.nats(best) < digits_nats) {
      best = std::move(rounded);
      free = std::move(others);
    } else {
      ++i;
    }
  }
  return best;
}

Tree rewritten(const Tree& tree, FormulaMisfit& misfit) {
  return Rewriting(misfit).run(tree);
}

Tree best_product(FormulaMisfit& misfit) {
  const std::vector<Tree> factors = elementary_factors(misfit.variables());
  Tree best = factors.front();
  double least = misfit.nats(best);
  const auto product = [](const Tree& a, const Tree& b) { return apply(Primitive::multiply, a, b); };
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (std::size_t j = i; j < factors.size(); ++j) {
      const Tree two = product(factors[i], factors[j]);
      for (std::size_t k = j; k < factors.size(); ++k) {
        Tree three = product(two, factors[k]);
        const double nats = misfit.nats(three);
        if (!(nats < least)) continue;
        least = nats;
        best = std::move(three);
      }
    }
  }
  return best;
}

}  // namespace demecal::inline formula_search
