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

/// Columns that those before them leave something of.
std::vector<Eigen::Index> independent_columns(const Eigen::MatrixXd& columns) {
  constexpr double kLeastShare = 1e-4;
  std::vector<Eigen::Index> kept;
  Eigen::MatrixXd basis(columns.rows(), 0);
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    Eigen::VectorXd rest = columns.col(i);
    for (int twice = 0; twice < 2; ++twice) rest -= basis * (basis.transpose() * rest).eval();
    if (!(rest.norm() > kLeastShare * columns.col(i).norm())) continue;
    kept.push_back(i);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
  }
  return kept;
}

/// Whether a move of the tool does to these poses what a joint's zero does: that of the last joint turns the tool
/// alone.
bool makes_up_for(const Effect& tool, const Effect& zero, const ChangeRows& rows, const CauseTrial& trial) {
  constexpr double kNothing = 1e-3;
  if (law_of(tool).subject() != Subject::tool || declared_flag(zero.kind) != &DeclaredModel::joint_offset) return false;
  const Eigen::MatrixXd basis = PivotedQr(rows.columns[place_of(tool, trial.effects)]).basis();
  const Eigen::MatrixXd& column = rows.columns[place_of(zero, trial.effects)];
  return (column - basis * (basis.transpose() * column).eval()).norm() < kNothing * column.norm();
}

}  // namespace

std::vector<ChangeCause> tested_causes(const ChangeRows& rows, const CauseTrial& trial) {
  constexpr double kSeen = 1.0, kAsLikely = 6.0;
  const double n = static_cast<double>(rows.values.size()), whole = rows.values.squaredNorm();
  struct Scored {
    double length;
    ChangeCause cause;
  };
  std::vector<Scored> scored;
  for (std::size_t i = 0; i < trial.effects.size(); ++i) {
    const Eigen::MatrixXd& columns = rows.columns[i];
    if (columns.norm() < kSeen || columns.cols() + 2 > columns.rows()) continue;
    const PivotedQr qr(columns);
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

Eigen::MatrixXd columns_of(const std::vector<ChangeCause>& found, const ChangeRows& rows,
                           const std::vector<Effect>& effects) {
  Eigen::MatrixXd all(rows.values.size(), 0);
  for (const ChangeCause& cause : found) {
    const Eigen::MatrixXd& own = rows.columns[place_of(cause.effect, effects)];
    all.conservativeResize(Eigen::NoChange, all.cols() + own.cols());
    all.rightCols(own.cols()) = own;
  }
  return all;
}

ChangeAmounts amounts_on(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values, double known_rows) {
  const std::vector<Eigen::Index> kept = independent_columns(columns);
  const Eigen::MatrixXd independent = columns(Eigen::all, kept);
  ChangeAmounts amounts{Eigen::VectorXd::Zero(columns.cols()), Eigen::VectorXd::Zero(columns.cols()),
                        PivotedQr(independent).basis()};
  amounts.values(kept) = least_squares_solution(independent, values);
  amounts.left = (values - columns * amounts.values).squaredNorm();
  const double freedom = known_rows + static_cast<double>(values.size()) - static_cast<double>(kept.size());
  amounts.variances(kept) = variances_by(independent, (known_rows + amounts.left) / freedom);
  return amounts;
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
