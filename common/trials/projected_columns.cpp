#include "trials/projected_columns.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline trials {
namespace {

/// The least and the greatest of a condition, such as the payload, of the rows (at least one).
std::pair<double, double> extremes(const std::vector<TrialRow>& rows, double TrialRow::*condition) {
  const auto [least, most] = std::ranges::minmax_element(rows, {}, condition);
  return {(*least).*condition, (*most).*condition};
}

}  // namespace

ProjectedColumns::ProjectedColumns(const Trial& trial, const TrialFit& fit) : linear_(linearized(trial, fit)) {
  constexpr double kFullWeight = 3.0;  // deviations up to which rows count in full
  weights_.resize(linear_.error_m.size());
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const double error_m = linear_.error_m.segment<3>(i / 3 * 3).norm();
    weights_[i] = std::min(1.0, kFullWeight * fit.deviation_m / error_m) / (fit.deviation_m * fit.deviation_m);
  }
  const Eigen::MatrixXd weighted = weights_.asDiagonal() * linear_.jacobian;
  Eigen::MatrixXd information = linear_.jacobian.transpose() * weighted;
  information.diagonal() += linear_.prior;
  factor_ = PivotedCholesky(information);
  weighted_ = weighted;
  weighted_error_ = weights_.cwiseProduct(linear_.error_m);
  taken_ = weighted_ * factor_.solve(weighted_.transpose() * linear_.error_m);
}

Eigen::VectorXd ProjectedColumns::with_error(const Eigen::MatrixXd& columns) const {
  return columns.transpose() * weighted_error_ - columns.transpose() * taken_;
}

Eigen::MatrixXd ProjectedColumns::with_itself(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd shared = weighted_.transpose() * columns;
  return columns.transpose() * weights_.asDiagonal() * columns - shared.transpose() * factor_.solve(shared);
}

ProjectedColumns::Products ProjectedColumns::of_column(const Eigen::VectorXd& column, std::size_t first) const {
  // Sums run in several lanes: to leave out a multiple of eight leading zeros keeps the order of each.
  constexpr Eigen::Index kLanes = 8;
  const Eigen::Index behind = column.size() - 3 * static_cast<Eigen::Index>(first) / kLanes * kLanes;
  const Eigen::MatrixXd there = column.tail(behind);
  const Eigen::MatrixXd shared = weighted_.bottomRows(behind).transpose() * there;
  const Eigen::VectorXd error =
      there.transpose() * weighted_error_.tail(behind) - there.transpose() * taken_.tail(behind);
  const Eigen::MatrixXd itself =
      there.transpose() * weights_.tail(behind).asDiagonal() * there - shared.transpose() * factor_.solve(shared);
  return {error[0], itself(0, 0)};
}

Eigen::VectorXd ProjectedColumns::coefficients(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd squares = with_itself(columns);
  squares.diagonal() *= 1.0 + 1e-9;
  return PivotedCholesky(squares).solve(with_error(columns));
}

double ProjectedColumns::gain_beyond(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& others) const {
  constexpr double kApart = 1e-6;  // of a column's square, that no other holds
  const auto gain_of = [&](const Eigen::MatrixXd& some) {
    Eigen::MatrixXd squares = with_itself(some);
    const Eigen::VectorXd sizes = squares.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    squares = sizes.asDiagonal() * squares * sizes.asDiagonal();
    squares.diagonal().array() += kApart;
    const Eigen::VectorXd together = sizes.cwiseProduct(Eigen::VectorXd(with_error(some)));
    return 0.5 * together.dot(PivotedCholesky(squares).solve(together));
  };
  if (others.cols() == 0) return gain_of(columns);
  Eigen::MatrixXd both(columns.rows(), others.cols() + columns.cols());
  both << others, columns;
  return gain_of(both) - gain_of(others);
}

double ProjectedColumns::gain(const Eigen::MatrixXd& columns) const {
  return 0.5 * with_error(columns).dot(coefficients(columns));
}

Eigen::VectorXd joint_column(const Trial& trial, const TrialFit& fit, int joint) {
  constexpr double kDerivativeStep = 1e-6;  // rad or m
  const FixedTurns turns(fit.chain);
  const auto point = [&](const TrialRow& row, const JointVector& joints) -> Eigen::Vector3d {
    return fit.sensor_from_base[static_cast<std::size_t>(row.station)] *
           (forward(turns, joints) * fit.tools_m[static_cast<std::size_t>(row.target)]);
  };
  Eigen::VectorXd column(3 * static_cast<Eigen::Index>(trial.rows.size()));
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    const TrialRow& row = trial.rows[i];
    JointVector joints = row.joints;
    joints[joint] += kDerivativeStep;
    column.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        (point(row, joints) - point(row, row.joints)) / kDerivativeStep;
  }
  return column;
}

Eigen::MatrixXd condition_columns(const Trial& trial, const TrialFit& fit) {
  const std::vector<TrialRow>& rows = trial.rows;
  std::vector<Eigen::MatrixXd> parts;
  if (std::ranges::any_of(rows, [](const TrialRow& row) { return row.sides.size() > 0; }))
    parts.push_back(joint_columns(trial, fit, [&rows](std::size_t row, int joint) {
      return rows[row].sides.size() > 0 ? rows[row].sides[joint] : 0.0;
    }));
  for (const auto condition : {&TrialRow::payload_kg, &TrialRow::temperature_celsius}) {
    const auto [least, most] = extremes(rows, condition);
    if (most > least)
      parts.push_back(joint_columns(trial, fit, [&, from = least, span = most - least](std::size_t row, int) {
        return (rows[row].*condition - from) / span;
      }));
  }
  Eigen::MatrixXd columns(3 * static_cast<Eigen::Index>(rows.size()), std::ssize(parts) * trial.chain.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    columns.middleCols(static_cast<Eigen::Index>(i) * trial.chain.size(), trial.chain.size()) = parts[i];
  return columns;
}

double most_by_conditions(const Trial& trial) {
  constexpr double kBySide = 3e-3, kPerNm = 4e-5, kPerKelvin = 1e-4, kGravity = 9.81;
  const auto span = [&](auto condition) {
    const auto [least, most] = extremes(trial.rows, condition);
    return most - least;
  };
  const bool sides = std::ranges::any_of(trial.rows, [](const TrialRow& row) { return row.sides.size() > 0; });
  return (sides ? kBySide : 0.0) + kPerNm * kGravity * trial.reach_m() * span(&TrialRow::payload_kg) +
         kPerKelvin * span(&TrialRow::temperature_celsius);
}

}  // namespace demecal::inline trials
