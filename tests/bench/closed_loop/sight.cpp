#include "sight.hpp"

#include <cmath>

#include "diagnosis/scan.hpp"

namespace demecal::bench {

Sight::Sight(const DiagnosisProblem& of, const DiagnosedModel& model) : of_(of), at_(linearize(of, model)) {}

double Sight::detectable(const NotFound& measure, const Effect& effect) const {
  EffectColumns columns;
  columns.append(measure.effect, of_.data.robot, at_.fitted.states);
  columns.append(effect, of_.data.robot, at_.fitted.states);
  columns.pack();
  const Scan scan(columns, {0.0, 0.0}, at_.fitted, at_.projection);
  const double needed = measure.smallest_detectable * std::sqrt(scan.scores()[0].visible.mean());
  const auto values = Eigen::Map<const Eigen::VectorXd>(effect.values.data(), std::ssize(effect.values));
  const Projection::Trial trial =
      at_.projection.trial(columns.dense(at_.fitted, 1) * values, RowMatrix::Zero(at_.judging.rows(), 1));
  return needed / trial.fitted.norm();
}

}  // namespace demecal::bench
