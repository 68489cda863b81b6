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

constexpr double kDependent = 1e-6;       ///< share of a column that is rounding
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
  return variance * moore_penrose_inverse(columns.transpose() * columns, kDependent * kDependent).inverse.diagonal();
}

/// What `basis` leaves of columns.
Eigen::MatrixXd outside_span(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns) {
  return columns - basis * (basis.transpose() * columns).eval();
}

/// Changes of a cause's coefficients that poses tell.
struct ToldChanges {
  Eigen::MatrixXd directions;        ///< by which its columns become orthonormal
  Eigen::VectorXd untold_variances;  ///< of its coefficients, by what is hardly told and left as it is; of unit noise
};

/// Those that these poses do not tell much less well than others of the same cause, and that stay apart from what
/// `basis` spans: by the sine of the angle to it, so that no unit of a coefficient matters.
ToldChanges told_apart(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& basis) {
  constexpr double kLeastShare = 0.01, kLeastSine = 0.03, kNothing = 1e-4;
  const SingularSystem own = singular_system(columns, Eigen::ComputeThinV);
  const double most = own.values.size() > 0 ? own.values[0] : 0.0;
  ToldChanges told{Eigen::MatrixXd(columns.cols(), 0), Eigen::VectorXd::Zero(columns.cols())};
  if (!(most > 0.0)) return told;
  const Eigen::Index count = (own.values.array() >= kLeastShare * most).count();
  for (Eigen::Index i = count; i < own.values.size() && own.values[i] > kNothing * most; ++i)
    told.untold_variances += (own.v.col(i) / own.values[i]).cwiseAbs2();
  told.directions = own.v.leftCols(count) * own.values.head(count).cwiseInverse().asDiagonal();
  if (basis.cols() == 0) return told;
  const SingularSystem sines = singular_system(outside_span(basis, columns * told.directions), Eigen::ComputeThinV);
  told.directions *= sines.v.leftCols((sines.values.array() >= kLeastSine).count()).eval();
  return told;
}

/// Whether a move of the tool does to these poses what a joint's zero does: that of the last joint turns the tool
/// alone.
bool makes_up_for(const Effect& tool, const Effect& zero, const ChangeRows& rows, const CauseTrial& trial) {
  constexpr double kNothing = 1e-3;
  if (law_of(tool).subject() != Subject::tool || declared_flag(zero.kind) != &DeclaredModel::joint_offset) return false;
  const Eigen::MatrixXd basis = PivotedQr(rows.columns[place_of(tool, trial.effects)]).basis();
  const Eigen::MatrixXd& column = rows.columns[place_of(zero, trial.effects)];
  return outside_span(basis, column).norm() < kNothing * column.norm();
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
  Eigen::VectorXd untold(0);
  ChangeAmounts amounts{{}, {}, Eigen::MatrixXd(n, 0)};
  for (const ChangeCause& cause : found) {
    const Eigen::MatrixXd& own = rows.columns[place_of(cause.effect, effects)];
    const auto [directions, untold_variances] = told_apart(own, amounts.basis);
    untold.conservativeResize(untold.size() + own.cols());
    untold.tail(own.cols()) = untold_variances;
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
  amounts.variances =
      (known_rows + amounts.left) / freedom * (untold + (by_told * inverse).cwiseProduct(by_told).rowwise().sum());
  return amounts;
}

ChangeRows left_by(const std::vector<ChangeCause>& found, const ChangeAmounts& amounts, const ChangeRows& rows,
                   const std::vector<Effect>& effects) {
  ChangeRows left = rows;
  left.values = outside_span(amounts.basis, rows.values);
  for (Eigen::MatrixXd& columns : left.columns) {
    const Eigen::MatrixXd orthonormal = columns * told_apart(columns, amounts.basis).directions;
    columns = outside_span(amounts.basis, orthonormal) * (orthonormal.transpose() * columns);
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
