#include "calibration/formula_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/rewrite.hpp"

namespace demecal {
namespace {

bool says_something(const Tree& formula) {
  return std::ranges::any_of(formula, [](const Node& node) { return node.primitive == Primitive::variable; });
}

/// Where rewriting begins: the members of the front whose likelihood less their length is best, the shortest, and the
/// best product.
std::vector<Tree> beginnings(const Population& front, FormulaMisfit& misfit, std::size_t most) {
  std::vector<std::pair<double, Tree>> ranked;  // the front's members come by ascending length
  for (const Individual& individual : front) {
    const double nats = misfit.nats(individual.tree);
    if (!says_something(individual.tree) || !std::isfinite(nats)) continue;
    ranked.emplace_back(nats + description_nats(individual.tree, misfit.variables(), misfit.poses()), individual.tree);
  }
  const std::size_t shortest = std::min(most / 2, ranked.size());
  std::stable_sort(ranked.begin() + static_cast<std::ptrdiff_t>(shortest), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Tree> trees{best_product(misfit)};
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i) trees.push_back(std::move(ranked[i].second));
  return trees;
}

struct Written {
  Tree formula;
  double price_nats = 0.0, fall_nats = 0.0;
};

/// Whether one formula is another in other words, or all but.
bool alike(const Tree& a, const Tree& b, FormulaMisfit& misfit) {
  constexpr double kCosine = 0.9;
  const Eigen::VectorXd left = misfit.residual(constant_tree(0.0));
  const Eigen::VectorXd by_a = left - misfit.residual(a), by_b = left - misfit.residual(b);
  return std::abs(by_a.dot(by_b)) >= kCosine * by_a.norm() * by_b.norm();
}

}  // namespace

std::vector<PricedFormula> formula_candidates(const FormulaTable& table, const Population& front, FormulaMisfit& misfit,
                                              std::size_t joints, std::size_t most) {
  std::vector<Written> written;
  if (front.empty() || misfit.variables() == 0) return {};
  for (const Tree& tree : beginnings(front, misfit, most)) {
    Written one{rewritten(tree, misfit), 0.0, 0.0};
    one.price_nats = kOutsideCatalogue_nats + std::log(static_cast<double>(joints)) +
                     description_nats(one.formula, misfit.variables(), misfit.poses());
    const double coefficient = 0.5 * std::log(static_cast<double>(misfit.poses()));
    one.fall_nats = misfit.gain_nats(one.formula) - coefficient - one.price_nats;
    written.push_back(std::move(one));
  }
  std::ranges::stable_sort(written, std::greater{}, &Written::fall_nats);
  std::vector<PricedFormula> found;
  std::vector<Tree> taken;
  for (const Written& one : written) {
    const auto says_the_same = [&](const Tree& other) { return alike(one.formula, other, misfit); };
    if (std::ranges::any_of(taken, says_the_same)) continue;
    taken.push_back(one.formula);
    Candidate candidate{.effect = symbolic_effect(table.joint), .name_nats = one.price_nats, .evolved = true};
    candidate.effect.formula = in_symbolic_variables(one.formula, table);
    if (table.reference_celsius) candidate.effect.settings["reference_celsius"] = *table.reference_celsius;
    found.push_back({std::move(candidate), one.fall_nats});
  }
  return found;
}

}  // namespace demecal
