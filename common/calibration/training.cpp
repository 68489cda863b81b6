#include "calibration/training.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

double round_scale(double mean_absolute) {
  if (!(mean_absolute > 1e-12)) return 1e-12;
  const double power = std::pow(10.0, std::floor(std::log10(mean_absolute)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= mean_absolute) return step * power;
  }
  return power;
}

std::vector<JointTraining> training_tables(const Chain& chain, const JointTargets& targets) {
  std::vector<JointTraining> tables;
  if (targets.poses.empty()) return tables;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (chain.joints[static_cast<std::size_t>(joint)].type != JointType::revolute) continue;
    JointTraining training = training_table(targets, joint);
    if (training.range_rad.upper - training.range_rad.lower > kLeastMotionRad) tables.push_back(std::move(training));
  }
  return tables;
}

JointCorrection correction_from(const JointTraining& training, const Tree& evolved) {
  return {apply(Primitive::multiply, constant_tree(training.scale_rad), evolved), training.branch, training.range_rad};
}

Tree evolved_tree(const JointCorrection& correction) {
  const Tree& product = correction.formula();  // of the scale, one node, and the tree
  DEMECAL_CHECK(
      product.size() > 2 && product[0].primitive == Primitive::multiply && product[1].primitive == Primitive::constant,
      "a formula of " << product.size() << " nodes");
  return {product.begin() + 2, product.end()};
}

}  // namespace demecal
