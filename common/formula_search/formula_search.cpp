#include "formula_search/formula_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "calibration/training.hpp"
#include "data/data_set.hpp"
#include "diagnosis/candidates.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "formula_search/rewrite.hpp"
#include "kinematics/chain.hpp"
#include "pieces/pieces.hpp"
#include "primitives/primitive.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "residuals/found_noise.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline formula_search {
namespace {

/// The places in symbolic_variables of what these poses know and what varies.
std::vector<std::uint8_t> known_variables(const Evidence& evidence, int joints) {
  std::vector<std::uint8_t> known;
  const auto add = [&](int variable) { known.push_back(static_cast<std::uint8_t>(variable)); };
  for (int joint = 0; joint < joints; ++joint) {
    const Interval& range = evidence.joint_ranges[static_cast<std::size_t>(joint)];
    if (range.upper - range.lower > kLeastMotion) add(joint);
  }
  if (evidence.masses) add(joints);
  if (evidence.approach) add(joints + 1);
  if (evidence.temperature) add(joints + 2);
  return known;
}

/// The values of symbolic_variables.
std::vector<double> values_at(const ArmState& state, const Chain& chain, int joint, double reference_celsius) {
  std::vector<double> values(state.joints().begin(), state.joints().end());
  values.push_back(state.torque(chain, joint));
  values.push_back(state.approach(joint));
  values.push_back(state.stop.temperature_celsius.value_or(reference_celsius) - reference_celsius);
  return values;
}

/// Weights from 0 to 1 of squared levers: the variance of an angle grows as its lever's square falls.
std::vector<double> lever_weights(const std::vector<double>& squared_levers) {
  const double typical = median(squared_levers);
  std::vector<double> weights;
  for (const double lever : squared_levers) weights.push_back(typical > 0 ? std::min(1.0, lever / typical) : 0.0);
  return weights;
}

FormulaTable formula_table(const Linearization& linearization, const Eigen::VectorXd& residual, const Chain& chain,
                           int joint, const Evidence& evidence) {
  FormulaTable result{joint, known_variables(evidence, chain.size()), {}, 1.0, std::nullopt};
  if (evidence.temperature) result.reference_celsius = evidence.mean_temperature_celsius;
  result.table.variables.resize(result.variables.size());
  std::vector<double> squared_levers;
  for (std::size_t i = 0; i < linearization.fitted.poses.size(); ++i) {
    const Eigen::Index first = linearization.fitted.first_row[i], count = linearization.fitted.rows_of_pose(i);
    const auto lever = linearization.fitted.motions.block(first, motion_column(joint, kTurnAboutZ), count, 1).col(0);
    const double square = lever.squaredNorm();
    squared_levers.push_back(square);
    result.table.target.push_back(square > 0 ? lever.dot(residual.segment(first, count)) / square : 0.0);
    const auto values = values_at(linearization.fitted.states[i], chain, joint, evidence.mean_temperature_celsius);
    for (std::size_t k = 0; k < result.variables.size(); ++k) {
      result.table.variables[k].push_back(values[result.variables[k]]);
    }
  }
  result.table.weight = lever_weights(squared_levers);
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < squared_levers.size(); ++i) {
    sum += result.table.weight[i] * std::abs(result.table.target[i]);
    weights += result.table.weight[i];
  }
  result.scale_rad = weights > 0 && sum > 0 ? sum / weights : 1.0;
  for (double& target : result.table.target) target /= result.scale_rad;
  return result;
}

bool has_variable(const Tree& formula) {
  return std::ranges::any_of(formula, [](const Node& node) { return node.primitive == Primitive::variable; });
}

/// Where rewriting begins: the members of the front whose likelihood less their length is best, the shortest, and the
/// best product.
std::vector<Tree> starting_formulas(const Population& front, FormulaMisfit& misfit, std::size_t most) {
  std::vector<std::pair<double, Tree>> ranked;  // the front's members come by ascending length
  for (const Individual& individual : front) {
    const double nats = misfit.nats(individual.tree);
    if (!has_variable(individual.tree) || !std::isfinite(nats)) continue;
    ranked.emplace_back(nats + description_nats(individual.tree, misfit.variables(), misfit.poses()), individual.tree);
  }
  const std::size_t shortest = std::min(most / 2, ranked.size());
  std::stable_sort(ranked.begin() + static_cast<std::ptrdiff_t>(shortest), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Tree> trees{best_product(misfit)};
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i) trees.push_back(std::move(ranked[i].second));
  return trees;
}

struct RewrittenFormula {
  Tree formula;
  double price_nats = 0.0, gain_nats = 0.0;
};

/// Whether one formula is another in other words, or all but.
bool explain_alike(const Tree& a, const Tree& b, FormulaMisfit& misfit) {
  constexpr double kCosine = 0.9;
  const Eigen::VectorXd residual = misfit.residual(constant_tree(0.0));
  const Eigen::VectorXd by_a = residual - misfit.residual(a), by_b = residual - misfit.residual(b);
  return std::abs(by_a.dot(by_b)) >= kCosine * by_a.norm() * by_b.norm();
}

constexpr std::size_t kMostPerJoint = 8;

using PricedFormulas = std::optional<std::vector<PricedFormula>>;

std::vector<JointTraining> training_of(const std::vector<FormulaTable>& tables) {
  std::vector<JointTraining> training;
  for (const FormulaTable& table : tables) {
    training.push_back({.joint = static_cast<std::uint32_t>(table.joint),
                        .table = table.table,
                        .scale_rad = table.scale_rad,
                        .range_rad = {},
                        .branch = {}});
  }
  return training;
}

class FormulaSearcher {
 public:
  FormulaSearcher(const DiagnosisProblem& problem, const DiagnosedModel& model, Evolver& evolver, EvolutionTerms terms)
      : problem_(problem), evolver_(evolver), terms_(std::move(terms)), linearization_(linearize(problem, model)) {}

  FormulaSearch run(double family_error, RandomStream random);

 private:
  PricedFormulas evolve_formulas(const Eigen::VectorXd& residual, Purpose purpose);

  const DiagnosisProblem& problem_;
  Evolver& evolver_;
  EvolutionTerms terms_;
  Linearization linearization_;
};

/// What evolution makes of such a residual, the best description first.
PricedFormulas FormulaSearcher::evolve_formulas(const Eigen::VectorXd& residual, Purpose purpose) {
  const std::vector<FormulaTable> tables = formula_tables(problem_, linearization_, residual);
  terms_.purpose = purpose;
  evolver_.announce(purpose);
  const EvolvedJoints evolved = evolver_.evolve(training_of(tables), terms_);
  if (!evolved.is_complete) return std::nullopt;
  std::vector<std::vector<PricedFormula>> of_joints(evolved.joints.size());
  in_pieces(of_joints.size(), [&](std::size_t i) {
    FormulaMisfit misfit(tables[i].table.variables, linearization_, tables[i].joint, residual);
    of_joints[i] = formula_candidates(tables[i], evolved.joints[i].front, misfit, tables.size(), kMostPerJoint);
  });
  std::vector<PricedFormula> formulas;
  for (std::vector<PricedFormula>& one : of_joints) std::ranges::move(one, std::back_inserter(formulas));
  std::ranges::stable_sort(formulas, std::greater{}, &PricedFormula::gain_nats);
  return formulas;
}

FormulaSearch FormulaSearcher::run(double family_error, RandomStream random) {
  const PricedFormulas found = evolve_formulas(linearization_.projection.residual(), Purpose::formulas);
  if (!found || found->empty() || found->front().gain_nats <= 0.0) return {};
  FormulaSearch result;
  std::vector<std::size_t> all_poses(linearization_.fitted.poses.size());
  std::iota(all_poses.begin(), all_poses.end(), std::size_t{0});
  const NullResiduals noise = null_residuals(linearization_.fitted, linearization_.projection, std::move(all_poses));
  const auto searches = static_cast<std::size_t>(std::ceil(1.0 / family_error - 1e-9));
  while (result.null_nats.size() + 1 < searches) {
    const PricedFormulas of_noise = evolve_formulas(noise.draw(1, random), Purpose::null_distribution);
    if (!of_noise) return {};
    const double gain_nats = of_noise->empty() ? 0.0 : std::max(0.0, of_noise->front().gain_nats);
    if (gain_nats >= found->front().gain_nats) return {};
    result.null_nats.insert(std::ranges::upper_bound(result.null_nats, gain_nats), gain_nats);
  }
  for (const PricedFormula& formula : *found) {
    if (formula.gain_nats > result.null_nats.back()) result.formulas.push_back(formula.candidate);
  }
  return result;
}

}  // namespace

std::vector<FormulaTable> formula_tables(const DiagnosisProblem& problem, const Linearization& linearization,
                                         const Eigen::VectorXd& residual) {
  const Chain& chain = problem.data.robot.chain;
  const Evidence evidence = evidence_of(problem.data, problem.fitted);
  std::vector<FormulaTable> tables;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (!is_revolute(chain, joint)) continue;
    tables.push_back(formula_table(linearization, residual, chain, joint, evidence));
  }
  return tables;
}

Tree in_symbolic_variables(Tree formula, const FormulaTable& table) {
  for (Node& node : formula) {
    if (node.primitive == Primitive::variable) node.variable = table.variables[node.variable];
  }
  return formula;
}

std::vector<PricedFormula> formula_candidates(const FormulaTable& table, const Population& front, FormulaMisfit& misfit,
                                              std::size_t joints, std::size_t most) {
  std::vector<RewrittenFormula> rewritten_formulas;
  if (front.empty() || misfit.variables() == 0) return {};
  for (const Tree& tree : starting_formulas(front, misfit, most)) {
    RewrittenFormula one{rewritten(tree, misfit), 0.0, 0.0};
    one.price_nats = kOutsideCatalogue_nats + std::log(static_cast<double>(joints)) +
                     description_nats(one.formula, misfit.variables(), misfit.poses());
    const double coefficient = 0.5 * std::log(static_cast<double>(misfit.poses()));
    one.gain_nats = misfit.gain_nats(one.formula) - coefficient - one.price_nats;
    rewritten_formulas.push_back(std::move(one));
  }
  std::ranges::stable_sort(rewritten_formulas, std::greater{}, &RewrittenFormula::gain_nats);
  std::vector<PricedFormula> found;
  std::vector<Tree> taken;
  for (const RewrittenFormula& one : rewritten_formulas) {
    const auto is_equivalent = [&](const Tree& other) { return explain_alike(one.formula, other, misfit); };
    if (std::ranges::any_of(taken, is_equivalent)) continue;
    taken.push_back(one.formula);
    Candidate candidate{.effect = symbolic_effect(table.joint), .naming_cost_nats = one.price_nats, .evolved = true};
    candidate.effect.formula = in_symbolic_variables(one.formula, table);
    if (table.reference_celsius) candidate.effect.settings["reference_celsius"] = *table.reference_celsius;
    found.push_back({std::move(candidate), one.gain_nats});
  }
  return found;
}

FormulaSearch search_formulas(const DiagnosisProblem& problem, const DiagnosedModel& model, Evolver& evolver,
                              EvolutionTerms terms, double family_error, RandomStream random) {
  return FormulaSearcher(problem, model, evolver, std::move(terms)).run(family_error, random);
}

}  // namespace demecal::inline formula_search
