#include "calibration/formula_tables.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/evidence.hpp"

namespace demecal {
namespace {

constexpr int kTurnAboutZ = 5;

/// The values that a formula of this joint may speak of.
std::vector<double> variables_at(const ArmState& state, const Chain& chain, int joint, double reference_celsius) {
  std::vector<double> values(state.joints().begin(), state.joints().end());
  values.push_back(state.torque(chain, joint));
  values.push_back(state.approach(joint));
  values.push_back(state.stop.temperature_celsius.value_or(reference_celsius) - reference_celsius);
  return values;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Weights from 0 to 1 of squared levers: the variance of an angle grows as its lever's square falls.
std::vector<double> weights_of(const std::vector<double>& squared_levers) {
  const double typical = median(squared_levers);
  std::vector<double> weights;
  for (const double lever : squared_levers) weights.push_back(typical > 0 ? std::min(1.0, lever / typical) : 0.0);
  return weights;
}

FormulaTable table_of(const Linearised& at, const Chain& chain, int joint, double reference_celsius) {
  FormulaTable result{joint, {}, 1.0, reference_celsius};
  result.table.variables.resize(static_cast<std::size_t>(chain.size()) + 3);
  std::vector<double> squared_levers;
  for (std::size_t i = 0; i < at.fitted.poses.size(); ++i) {
    const Eigen::Index first = at.fitted.first_row[i], count = at.fitted.rows_of_pose(i);
    const auto lever = at.fitted.motions.block(first, motion_column(joint, kTurnAboutZ), count, 1).col(0);
    const double square = lever.squaredNorm();
    squared_levers.push_back(square);
    result.table.target.push_back(square > 0 ? lever.dot(at.projection.left().segment(first, count)) / square : 0.0);
    const auto values = variables_at(at.fitted.states[i], chain, joint, reference_celsius);
    for (std::size_t k = 0; k < values.size(); ++k) result.table.variables[k].push_back(values[k]);
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

std::vector<FormulaTable> formula_tables(const DiagnosisData& of, const DiagnosedModel& model) {
  const Linearised at = linearise(of, model);
  const Chain& chain = of.data.robot.chain;
  const double reference = evidence_of(of.data, of.fitted).mean_temperature_celsius;
  std::vector<FormulaTable> tables;
  for (int joint = 0; joint < chain.size(); ++joint) {
    if (chain.joints[static_cast<std::size_t>(joint)].type != JointType::revolute) continue;
    tables.push_back(table_of(at, chain, joint, reference));
  }
  return tables;
}

}  // namespace demecal
