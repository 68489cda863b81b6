#include "updating/change_causes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "next_measurement/next_measurement.hpp"
#include "parameters/declared_model.hpp"
#include "random/distributions.hpp"
#include "updating/model_amounts.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kFound = 1.645 + 1.282;  ///< one-sided at 5 %, nine times in ten

double usual_size(const std::string& unit) {
  return unit == "m" ? 2e-4 : unit == "rad" ? 3e-4 : 0.0;
}

bool registers(const Effect& effect) {
  return declared_flag(effect.kind) == &DeclaredModel::registration;
}

/// `variances`: of the cause's coefficients.
void fill_size(const Eigen::VectorXd& variances, const Robot& robot, ChangeCause& cause) {
  const auto labels = law_of(cause.effect).coefficients(cause.effect, robot);
  cause.unit = labels.front().unit;
  std::vector<Eigen::Index> same;
  double square = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i].unit != cause.unit) continue;
    same.push_back(static_cast<Eigen::Index>(i));
    square += cause.effect.values[i] * cause.effect.values[i];
  }
  cause.size = same.size() == 1 ? cause.effect.values[static_cast<std::size_t>(same.front())] : std::sqrt(square);
  double mean = 0.0;
  for (const Eigen::Index i : same) mean += variances[i] / static_cast<double>(same.size());
  cause.standard_error = std::sqrt(std::max(mean, 0.0));
  cause.detectable = kFound * cause.standard_error;
  const double usual = usual_size(cause.unit);
  if (usual > 0.0 && cause.standard_error > 0.0)
    cause.power = 0.5 * std::erfc((1.645 - usual / cause.standard_error) / std::sqrt(2.0));
}

Eigen::VectorXd variances_by(const Eigen::MatrixXd& columns, double variance) {
  return variance * moore_penrose_inverse(columns.transpose() * columns).inverse.diagonal();
}

/// What `basis` leaves of columns.
Eigen::MatrixXd beyond(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns) {
  return columns - basis * (basis.transpose() * columns).eval();
}

/// Changes of a cause's coefficients (columns) of which its columns become orthonormal, and which stay apart from what
/// `basis` spans: by the sine of the angle to it, so that no unit of a coefficient matters.
Eigen::MatrixXd told_apart(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& basis) {
  constexpr double kLeastShare = 1e-4, kLeastSine = 0.03;
  Eigen::VectorXd scale = columns.colwise().norm();
  scale = (scale.array() > 0.0).select(scale.array().inverse(), 0.0);
  const Eigen::MatrixXd orthonormal =
      scale.asDiagonal() * PivotedQr(columns * scale.asDiagonal(), kLeastShare).to_basis();
  if (basis.cols() == 0 || orthonormal.cols() == 0) return orthonormal;
  const SingularSystem sines = singular_system(beyond(basis, columns * orthonormal), Eigen::ComputeThinV);
  return orthonormal * sines.v.leftCols((sines.values.array() >= kLeastSine).count());
}

/// Whether a move of the tool does to these poses what a joint's zero does: that of the last joint turns the tool
/// alone.
bool makes_up_for(const Effect& tool, const Effect& zero, const ChangeRows& rows, const CauseTrial& trial) {
  constexpr double kNothing = 1e-3;
  if (law_of(tool).subject() != Subject::tool || declared_flag(zero.kind) != &DeclaredModel::joint_offset) return false;
  const Eigen::MatrixXd basis = PivotedQr(rows.columns[place_of(tool, trial.effects)]).basis();
  const Eigen::MatrixXd& column = rows.columns[place_of(zero, trial.effects)];
  return beyond(basis, column).norm() < kNothing * column.norm();
}

}  // namespace

std::vector<ChangeCause> tested_causes(const ChangeRows& rows, const CauseTrial& trial) {
  constexpr double kSeen = 1.0, kAsLikely = 6.0, kDependent = 1e-9;
  const double n = static_cast<double>(rows.values.size()), whole = rows.values.squaredNorm();
  struct Scored {
    double length;
    ChangeCause cause;
  };
  std::vector<Scored> scored;
  for (std::size_t i = 0; i < trial.effects.size(); ++i) {
    const Eigen::MatrixXd& columns = rows.columns[i];
    if (columns.norm() < kSeen || columns.cols() + 2 > columns.rows()) continue;
    const PivotedQr qr(columns, kDependent);
    const auto rank = static_cast<double>(qr.rank());
    ChangeCause cause;
    cause.effect = trial.effects[i];
    cause.is_registration = registers(cause.effect);
    const Eigen::VectorXd values = qr.solve(rows.values);
    cause.effect.values.assign(values.begin(), values.end());
    cause.by_model = amount_by_model(trial.robot, trial.data, trial.poses, cause.effect);
    const double left = (rows.values - columns * values).squaredNorm();
    const double freedom = trial.known_rows + n - rank, variance = (trial.known_rows + left) / freedom;
    cause.p_value = fisher_p_value(std::max(0.0, whole - left) / rank / variance, rank, freedom);
    fill_size(variances_by(columns, variance), trial.data.robot, cause);
    scored.push_back(
        {(trial.known_rows + n) * std::log(trial.known_rows + left) + rank * std::log(n), std::move(cause)});
  }
  std::sort(scored.begin(), scored.end(), [](const Scored& a, const Scored& b) { return a.length < b.length; });
  std::vector<ChangeCause> causes;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    ChangeCause& cause = scored[i].cause;
    cause.p_family = 1.0 - std::pow(1.0 - cause.p_value, static_cast<double>(scored.size()));
    for (std::size_t k = 1; i == 0 && k < scored.size(); ++k)
      if (scored[k].length - scored[0].length < kAsLikely ||
          makes_up_for(scored[k].cause.effect, cause.effect, rows, trial))
        cause.rivals.push_back(to_string(scored[k].cause.effect));
    causes.push_back(std::move(cause));
  }
  return causes;
}

std::size_t place_of(const Effect& effect, const std::vector<Effect>& effects) {
  return static_cast<std::size_t>(
      std::ranges::find_if(effects, [&](const Effect& one) { return one.same_law_as(effect); }) - effects.begin());
}

ChangeAmounts amounts_on(const std::vector<ChangeCause>& found, const ChangeRows& rows,
                         const std::vector<Effect>& effects, double known_rows) {
  const Eigen::Index n = rows.values.size();
  Eigen::MatrixXd told(n, 0), by_told(0, 0);
  ChangeAmounts amounts{{}, {}, Eigen::MatrixXd(n, 0)};
  for (const ChangeCause& cause : found) {
    const Eigen::MatrixXd& own = rows.columns[place_of(cause.effect, effects)];
    const Eigen::MatrixXd directions = told_apart(own, amounts.basis);
    told.conservativeResize(Eigen::NoChange, told.cols() + directions.cols());
    told.rightCols(directions.cols()) = own * directions;
    by_told.conservativeResizeLike(Eigen::MatrixXd::Zero(by_told.rows() + directions.rows(), told.cols()));
    by_told.bottomRightCorner(directions.rows(), directions.cols()) = directions;
    amounts.basis = PivotedQr(told).basis();
  }
  const Eigen::VectorXd sizes = least_squares_solution(told, rows.values);
  amounts.values = by_told * sizes;
  amounts.left = (rows.values - told * sizes).squaredNorm();
  const double freedom = known_rows + static_cast<double>(n - told.cols());
  const Eigen::MatrixXd inverse = moore_penrose_inverse(told.transpose() * told).inverse;
  amounts.variances = (known_rows + amounts.left) / freedom * (by_told * inverse).cwiseProduct(by_told).rowwise().sum();
  return amounts;
}

ChangeRows left_by(const std::vector<ChangeCause>& found, const ChangeAmounts& amounts, const ChangeRows& rows,
                   const std::vector<Effect>& effects) {
  ChangeRows left = rows;
  left.values = beyond(amounts.basis, rows.values);
  for (Eigen::MatrixXd& columns : left.columns) {
    const Eigen::MatrixXd directions = told_apart(columns, amounts.basis);
    const Eigen::MatrixXd orthonormal = columns * directions;
    columns = beyond(amounts.basis, orthonormal) * (orthonormal.transpose() * columns);
  }
  for (const ChangeCause& cause : found) left.columns[place_of(cause.effect, effects)].setZero();
  return left;
}

void set_amounts(const Eigen::VectorXd& values, const Eigen::VectorXd& variances, const Robot& robot,
                 std::vector<ChangeCause>& found) {
  Eigen::Index first = 0;
  for (ChangeCause& cause : found) {
    const auto count = static_cast<Eigen::Index>(cause.effect.values.size());
    const Eigen::VectorXd own = values.segment(first, count);
    cause.effect.values.assign(own.begin(), own.end());
    fill_size(variances.segment(first, count), robot, cause);
    first += count;
  }
}

}  // namespace demecal::inline updating
