#include "calibration/training.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "expression/simplify.hpp"
#include "primitives/primitive.hpp"
#include "random/distributions.hpp"

namespace demecal::inline calibration {
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
const Tree& scaled_product(const JointCorrection& correction) {
  const Tree& product = correction.formula();
  DEMECAL_CHECK(
      product.size() > 2 && product[0].primitive == Primitive::multiply && product[1].primitive == Primitive::constant,
      "a formula of " << product.size() << " nodes");
  return product;
}

constexpr double kMostOverTarget = 3.0;

/// The largest target errors are often those of poses near a singularity.
double large_target_rad(const JointTraining& training) {
  std::vector<double> sizes;
  const double least = training.table.loss == Loss::squared ? median(training.table.weight) : 1.0;
  for (std::size_t row = 0; row < training.table.target.size(); ++row) {
    if (training.table.weight[row] >= least) sizes.push_back(std::abs(training.table.target[row]));
  }
  if (sizes.empty()) return 0.0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place * training.scale_rad;
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
  const Tree& product = scaled_product(correction);
  return {product.begin() + 2, product.end()};
}

double evolved_scale_rad(const JointCorrection& correction) {
  return scaled_product(correction)[1].value;
}

double correction_limit_rad(const JointTraining& training) {
  return std::min(kMostOverTarget * large_target_rad(training), training.largest_rad);
}

void limit_formulas(JointTraining& training) {
  training.table.limit = correction_limit_rad(training) / training.scale_rad;
}

JointCorrection shortened(const JointCorrection& correction) {
  if (correction.is_neutral()) return correction;
  constexpr int kGrid = 512;
  std::vector<std::vector<double>> angles_rad(1);
  const auto [lower, upper] = correction.range_rad();
  for (int i = 0; i <= kGrid; ++i) angles_rad[0].push_back(std::lerp(lower, upper, static_cast<double>(i) / kGrid));
  return {simplified_over(correction.formula(), angles_rad), correction.branch(), correction.range_rad()};
}

CorrectedRobot with_shortened_corrections(CorrectedRobot robot) {
  for (JointCorrection& correction : robot.corrections) correction = shortened(correction);
  return robot;
}

bool has_corrections(const CorrectedRobot& robot) {
  return !std::ranges::all_of(robot.corrections, &JointCorrection::is_neutral);
}

CorrectedRobot without_corrections(CorrectedRobot robot) {
  std::ranges::fill(robot.corrections, JointCorrection{});
  return robot;
}

}  // namespace demecal::inline calibration
