#include "calibration/training.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/correction_limit.hpp"
#include "errors/check.hpp"

namespace demecal {
namespace {

constexpr double kLeastMotionRad = 1e-3;

JointTraining training_table(const JointTargets& targets, int joint) {
  JointTraining training;
  training.joint = static_cast<std::uint32_t>(joint);
  training.branch = targets.branches[static_cast<std::size_t>(joint)];
  training.table.variables.resize(1);
  double sum = 0.0, weights = 0.0;
  for (std::size_t row = 0; row < targets.poses.size(); ++row) {
    training.table.variables[0].push_back(targets.commanded[row][joint]);
    training.table.target.push_back(targets.error[row][joint]);
    sum += std::abs(targets.error[row][joint]) * targets.weight[row];
    weights += targets.weight[row];
  }
  training.table.weight = targets.weight;
  training.scale_rad = round_scale(weights > 0.0 ? sum / weights : 0.0);
  for (double& target : training.table.target) target /= training.scale_rad;
  const auto [lowest, highest] =
      std::minmax_element(training.table.variables[0].begin(), training.table.variables[0].end());
  training.range_rad = {*lowest, *highest};
  return training;
}

/// A factor before the formula takes the divisor in.
Tree divided(const Tree& formula, double divisor) {
  const bool has_factor =
      formula.size() > 2 && formula[0].primitive == Primitive::multiply && formula[1].primitive == Primitive::constant;
  const double factor = (has_factor ? formula[1].value : 1.0) / divisor;
  const Tree rest = has_factor ? Tree(formula.begin() + 2, formula.end()) : formula;
  return factor == 1.0 ? rest : apply(Primitive::multiply, constant_tree(factor), rest);
}

/// Of the scale, one node, and the tree.
const Tree& product_of(const JointCorrection& correction) {
  const Tree& product = correction.formula();
  DEMECAL_CHECK(
      product.size() > 2 && product[0].primitive == Primitive::multiply && product[1].primitive == Primitive::constant,
      "a formula of " << product.size() << " nodes");
  return product;
}

}  // namespace

double round_scale(double mean_absolute) {
  if (!(mean_absolute > 1e-12)) return 1e-12;
  const double power = std::pow(10.0, std::floor(std::log10(mean_absolute)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= mean_absolute) return step * power;
  }
  return power;
}

std::vector<JointTraining> training_tables(const Chain& chain, const JointTargets& targets,
                                           const CorrectionOptions& options) {
  std::vector<JointTraining> tables;
  if (targets.poses.empty()) return tables;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (!is_revolute(chain, joint)) continue;
    JointTraining training = training_table(targets, joint);
    if (training.range_rad.upper - training.range_rad.lower <= kLeastMotionRad) continue;
    training.largest_rad = options.largest_rad;
    training.table.seeds = seed_trees(options.seeds, training);
    limit_formulas(training);
    tables.push_back(std::move(training));
  }
  return tables;
}

std::vector<Tree> seed_trees(const std::vector<SeedFormula>& seeds, const JointTraining& training) {
  std::vector<Tree> trees;
  for (const SeedFormula& seed : seeds) {
    if (seed.joint == SeedFormula::kEveryJoint || seed.joint == static_cast<int>(training.joint))
      trees.push_back(divided(seed.formula, training.scale_rad));
  }
  return trees;
}

JointCorrection correction_from(const JointTraining& training, const Tree& evolved) {
  return {apply(Primitive::multiply, constant_tree(training.scale_rad), evolved), training.branch, training.range_rad};
}

Tree evolved_tree(const JointCorrection& correction) {
  const Tree& product = product_of(correction);
  return {product.begin() + 2, product.end()};
}

double evolved_scale_rad(const JointCorrection& correction) {
  return product_of(correction)[1].value;
}

}  // namespace demecal
