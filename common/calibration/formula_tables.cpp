#include "calibration/formula_tables.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/evidence.hpp"
#include "fitting/median.hpp"

namespace demecal {
namespace {

constexpr double kLeastMotion = 0.05;  ///< rad or m: joints that move less say nothing

/// The places in symbolic_variables of what these poses know and what varies.
std::vector<std::uint8_t> variables_of(const Evidence& evidence, int joints) {
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
std::vector<double> weights_of(const std::vector<double>& squared_levers) {
  const double typical = median(squared_levers);
  std::vector<double> weights;
  for (const double lever : squared_levers) weights.push_back(typical > 0 ? std::min(1.0, lever / typical) : 0.0);
  return weights;
}

FormulaTable table_of(const Linearised& at, const Eigen::VectorXd& left, const Chain& chain, int joint,
                      const Evidence& evidence) {
  FormulaTable result{joint, variables_of(evidence, chain.size()), {}, 1.0, std::nullopt};
  if (evidence.temperature) result.reference_celsius = evidence.mean_temperature_celsius;
  result.table.variables.resize(result.variables.size());
  std::vector<double> squared_levers;
  for (std::size_t i = 0; i < at.fitted.poses.size(); ++i) {
    const Eigen::Index first = at.fitted.first_row[i], count = at.fitted.rows_of_pose(i);
    const auto lever = at.fitted.motions.block(first, motion_column(joint, kTurnAboutZ), count, 1).col(0);
    const double square = lever.squaredNorm();
    squared_levers.push_back(square);
    result.table.target.push_back(square > 0 ? lever.dot(left.segment(first, count)) / square : 0.0);
    const auto values = values_at(at.fitted.states[i], chain, joint, evidence.mean_temperature_celsius);
    for (std::size_t k = 0; k < result.variables.size(); ++k) {
      result.table.variables[k].push_back(values[result.variables[k]]);
    }
  }
  result.table.weight = weights_of(squared_levers);
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < squared_levers.size(); ++i) {
    sum += result.table.weight[i] * std::abs(result.table.target[i]);
    weights += result.table.weight[i];
  }
  result.scale_rad = weights > 0 && sum > 0 ? sum / weights : 1.0;
  for (double& target : result.table.target) target /= result.scale_rad;
  return result;
}

}  // namespace

std::vector<FormulaTable> formula_tables(const DiagnosisData& of, const Linearised& at, const Eigen::VectorXd& left) {
  const Chain& chain = of.data.robot.chain;
  const Evidence evidence = evidence_of(of.data, of.fitted);
  std::vector<FormulaTable> tables;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (!is_revolute(chain, joint)) continue;
    tables.push_back(table_of(at, left, chain, joint, evidence));
  }
  return tables;
}

Tree in_symbolic_variables(Tree formula, const FormulaTable& table) {
  for (Node& node : formula) {
    if (node.primitive == Primitive::variable) node.variable = table.variables[node.variable];
  }
  return formula;
}

}  // namespace demecal
