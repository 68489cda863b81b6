#include "calibration/formula_search.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/formula_candidates.hpp"
#include "residuals/noise.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostPerJoint = 8;

using Found = std::optional<std::vector<PricedFormula>>;

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

class Search {
 public:
  Search(const DiagnosisProblem& of, const DiagnosedModel& model, Evolver& evolver, EvolutionTerms terms)
      : of_(of), evolver_(evolver), terms_(std::move(terms)), at_(linearize(of, model)) {}

  FormulaSearch run(double family_error, RandomStream random);

 private:
  Found found_in(const Eigen::VectorXd& left, Purpose purpose);

  const DiagnosisProblem& of_;
  Evolver& evolver_;
  EvolutionTerms terms_;
  Linearization at_;
};

/// What evolution makes of such a residual, the best description first.
Found Search::found_in(const Eigen::VectorXd& left, Purpose purpose) {
  const std::vector<FormulaTable> tables = formula_tables(of_, at_, left);
  terms_.purpose = purpose;
  evolver_.announce(purpose);
  const EvolvedJoints evolved = evolver_.evolve(training_of(tables), terms_);
  if (!evolved.is_complete) return std::nullopt;
  std::vector<PricedFormula> all;
  for (std::size_t i = 0; i < evolved.joints.size(); ++i) {
    FormulaMisfit misfit(tables[i].table.variables, at_, tables[i].joint, left);
    std::ranges::move(formula_candidates(tables[i], evolved.joints[i].front, misfit, tables.size(), kMostPerJoint),
                      std::back_inserter(all));
  }
  std::ranges::stable_sort(all, std::greater{}, &PricedFormula::fall_nats);
  return all;
}

FormulaSearch Search::run(double family_error, RandomStream random) {
  const Found found = found_in(at_.projection.residual(), Purpose::formulas);
  if (!found || found->empty() || found->front().fall_nats <= 0.0) return {};
  FormulaSearch result;
  const NullNoise noise(at_.fitted, at_.projection);
  const auto searches = static_cast<std::size_t>(std::ceil(1.0 / family_error - 1e-9));
  while (result.luck_nats.size() + 1 < searches) {
    const Found luck = found_in(noise.residual(random), Purpose::null_distribution);
    if (!luck) return {};
    const double fall_nats = luck->empty() ? 0.0 : std::max(0.0, luck->front().fall_nats);
    if (fall_nats >= found->front().fall_nats) return {};
    result.luck_nats.insert(std::ranges::upper_bound(result.luck_nats, fall_nats), fall_nats);
  }
  for (const PricedFormula& formula : *found) {
    if (formula.fall_nats > result.luck_nats.back()) result.formulas.push_back(formula.candidate);
  }
  return result;
}

}  // namespace

FormulaSearch search_formulas(const DiagnosisProblem& of, const DiagnosedModel& model, Evolver& evolver,
                              EvolutionTerms terms, double family_error, RandomStream random) {
  return Search(of, model, evolver, std::move(terms)).run(family_error, random);
}

}  // namespace demecal
