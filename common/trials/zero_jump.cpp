#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/point_pairs.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

constexpr std::size_t kFewestAside = 5;  ///< rows on either side of a jump
constexpr double kJumpGain = 50.0;       ///< log likelihood that another zero must gain, for each row of a pose
constexpr double kGainOverDrift = 25.0;  ///< the same over drift
constexpr double kJumpFall = 0.6;        ///< ratio of median errors: the fit has taken a part of the jump
constexpr double kJumpDeviations = 3.0;  ///< that points must jump by at the least
constexpr double kJumpCap = 6.0;         ///< deviations beyond which an error says no more
constexpr double kMostJump = 0.035;      ///< rad or m: more is no change of a zero but another way to read the joint
constexpr int kRefits = 4;

/// Nothing before a row, the column from there on.
Eigen::VectorXd from_row(const Eigen::VectorXd& column, std::size_t row) {
  Eigen::VectorXd behind = column;
  behind.head(3 * static_cast<Eigen::Index>(row)).setZero();
  return behind;
}

struct JumpStart {
  int joint = -1;
  std::size_t row = 0;
  double gain = 0.0, by = 0.0;
};

JumpStart best_start(const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected) {
  JumpStart best;
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    const Eigen::VectorXd column = joint_column(trial, fit, joint);
    for (std::size_t row = kFewestAside; row + kFewestAside <= trial.rows.size(); ++row) {
      const auto [with_error, with_itself] = projected.of_column(from_row(column, row), row);
      const double gain = 0.5 * with_error * with_error / with_itself;
      if (gain > best.gain) best = {joint, row, gain, with_error / with_itself};
    }
  }
  return best;
}

/// The most that drift of all joints gains, linear or settling sooner or later.
double drift_gain(const Trial& trial, const TrialFit& fit, const ProjectedColumns& projected) {
  double most = 0.0;
  const auto n = static_cast<double>(trial.rows.size());
  const Eigen::MatrixXd of_joints = joint_columns(trial, fit, [](std::size_t, int) { return 1.0; });
  for (const double settling : {0.1, 0.3, 1e3}) {
    Eigen::MatrixXd columns = of_joints;
    for (Eigen::Index i = 0; i < columns.rows(); ++i)
      columns.row(i) *= settling * -std::expm1(-static_cast<double>(i / 3) / n / settling);
    most = std::max(most, projected.gain(columns));
  }
  return most;
}

Trial jumped(Trial trial, int joint, std::size_t row, double by) {
  for (std::size_t i = row; i < trial.rows.size(); ++i) trial.rows[i].joints[joint] += by;
  return trial;
}

double capped_square(double error_m, double deviation_m) {
  const double off = std::min(error_m / deviation_m, kJumpCap);
  return off * off;
}

double gained(const std::vector<double>& before, const TrialFit& after) {
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum += 0.5 * (capped_square(before[i], after.deviation_m) - capped_square(after.error_m[i], after.deviation_m));
  return sum;
}

/// The row from which the joint's other value fits better than the given one, by a fit to both.
std::size_t best_row(const Trial& trial, const TrialFit& fit, int joint, double by) {
  std::vector<double> gains;
  for (TrialRow row : trial.rows) {
    const double given = (row.point_m - predicted_point(fit, row)).norm();
    row.joints[joint] += by;
    gains.push_back(capped_square(given, fit.deviation_m) -
                    capped_square((row.point_m - predicted_point(fit, row)).norm(), fit.deviation_m));
  }
  double sum = 0.0, most = 0.0;
  std::size_t best = gains.size();
  for (std::size_t row = gains.size(); row-- > kFewestAside;) {
    sum += gains[row];
    if (sum > most && row + kFewestAside <= gains.size()) most = sum, best = row;
  }
  return best;
}

double median_between(const std::vector<double>& errors, std::size_t begin, std::size_t end) {
  return median(
      {errors.begin() + static_cast<std::ptrdiff_t>(begin), errors.begin() + static_cast<std::ptrdiff_t>(end)});
}

bool has_station(const StationZero& zero, const TrialRow& row) {
  return std::ranges::find(zero.stations, row.station) != zero.stations.end();
}

/// What moves the joint at those stations alone, of what moves it at all of them.
Eigen::VectorXd at_stations(Eigen::VectorXd column, const Trial& trial, const std::vector<int>& stations) {
  for (std::size_t i = 0; i < trial.rows.size(); ++i)
    if (std::ranges::find(stations, trial.rows[i].station) == stations.end())
      column.segment<3>(3 * static_cast<Eigen::Index>(i)).setZero();
  return column;
}

Eigen::VectorXd column_at(const Trial& trial, const TrialFit& fit, const StationZero& zero) {
  return at_stations(joint_column(trial, fit, zero.joint), trial, zero.stations);
}

/// Every station behind the first, alone and with all that follow it; of more than two the first one too.
std::vector<std::vector<int>> groups_of_stations(int count) {
  std::vector<std::vector<int>> groups;
  for (int first = count > 2 ? 0 : 1; first < count; ++first) {
    groups.push_back({first});
    if (first == 0 || first + 1 == count) continue;
    groups.push_back({});
    for (int station = first; station < count; ++station) groups.back().push_back(station);
  }
  return groups;
}

StationZero likeliest_zero(const Trial& trial, const TrialFit& fit) {
  const ProjectedColumns projected(trial, fit);
  const Eigen::MatrixXd columns = joint_columns(trial, fit, [](std::size_t, int) { return 1.0; });
  StationZero best;
  double most = 0.0;
  for (const std::vector<int>& stations : groups_of_stations(trial.stations)) {
    for (int joint = 0; joint < trial.chain.size(); ++joint) {
      StationZero one{.joint = joint, .stations = stations};
      const Eigen::VectorXd column = at_stations(columns.col(joint), trial, stations);
      const double with_error = projected.with_error(column)[0], with_itself = projected.with_itself(column)(0, 0);
      const double gain = 0.5 * with_error * with_error / with_itself;
      if (gain <= most) continue;
      most = gain;
      one.by = with_error / with_itself;
      best = std::move(one);
    }
  }
  return best;
}

/// The larger median, of the rows at those stations and of the others.
double larger_median(const Trial& trial, const TrialFit& fit, const StationZero& zero) {
  std::vector<double> there, elsewhere;
  for (std::size_t i = 0; i < trial.rows.size(); ++i)
    (has_station(zero, trial.rows[i]) ? there : elsewhere).push_back(fit.error_m[i]);
  return std::max(median(std::move(there)), median(std::move(elsewhere)));
}

}  // namespace

std::optional<StationZero> find_station_zero(const Trial& trial, const TrialFit& fit) {
  if (trial.stations < 2 || !fit.has_links()) return std::nullopt;
  StationZero zero = likeliest_zero(trial, fit);
  if (zero.joint < 0) return std::nullopt;
  TrialFit changed;
  for (int i = 0; i < kRefits; ++i) {
    Trial other = trial;
    for (TrialRow& row : other.rows)
      if (has_station(zero, row)) row.joints[zero.joint] += zero.by;
    changed = fit_arm(other, fit_base_and_tools(other));
    if (!changed.has_links()) return std::nullopt;
    if (i + 1 == kRefits) break;
    const ProjectedColumns again(other, changed);
    const Eigen::VectorXd column = column_at(other, changed, zero);
    zero.by += again.with_error(column)[0] / again.with_itself(column)(0, 0);
  }
  zero.as_given_m = larger_median(trial, fit, zero);
  zero.if_changed_m = larger_median(trial, changed, zero);
  const double least = kJumpGain * changed.rows_per_pose;
  if (std::abs(zero.by) > kMostJump || zero.if_changed_m > kJumpFall * zero.as_given_m ||
      zero.as_given_m < std::max(kJumpDeviations * changed.deviation_m, kSmallestShift_m) ||
      gained(fit.error_m, changed) < least || gained(fit_arm_to_all(trial, fit).error_m, changed) < least)
    return std::nullopt;
  if (std::abs(zero.by) > most_by_conditions(trial)) return zero;
  const double sharper = fit.deviation_m / changed.deviation_m;
  const double beyond =
      sharper * sharper *
      ProjectedColumns(trial, fit).gain_beyond(column_at(trial, fit, zero), condition_columns(trial, fit));
  if (beyond < kGainOverDrift * fit.rows_per_pose) return std::nullopt;
  return zero;
}

std::optional<Jump> find_zero_jump(const Trial& trial, const TrialFit& fit) {
  const std::size_t n = trial.rows.size();
  if (n < 2 * kFewestAside + 2 || !fit.has_links()) return std::nullopt;
  const ProjectedColumns projected(trial, fit);
  const JumpStart start = best_start(trial, fit, projected);
  if (start.gain < kGainOverDrift) return std::nullopt;
  Jump jump{{.first_row = start.row, .joint = start.joint, .by = start.by, .numbers = 1}, trial, fit};
  for (int i = 0; i < kRefits; ++i) {
    jump.trial = jumped(trial, start.joint, jump.move.first_row, jump.move.by);
    jump.fit = fit_arm(jump.trial, fit_base_and_tools(jump.trial));
    if (!jump.fit.has_links()) return std::nullopt;
    if (i + 1 == kRefits) break;
    const ProjectedColumns again(jump.trial, jump.fit);
    const Eigen::VectorXd column = from_row(joint_column(jump.trial, jump.fit, start.joint), jump.move.first_row);
    const auto [with_error, with_itself] = again.of_column(column, jump.move.first_row);
    jump.move.by += with_error / with_itself;
    jump.move.first_row = best_row(trial, jump.fit, start.joint, jump.move.by);
    if (jump.move.first_row == n) return std::nullopt;
  }
  if (std::abs(jump.move.by) > kMostJump) return std::nullopt;
  const std::size_t row = jump.move.first_row;
  const bool shorter_before = row < n - row;
  jump.move.as_given_m = std::max(median_between(fit.error_m, 0, row), median_between(fit.error_m, row, n));
  jump.move.if_changed_m = median_between(jump.fit.error_m, shorter_before ? 0 : row, shorter_before ? row : n);
  const Eigen::VectorXd shift = jump.move.by * from_row(joint_column(trial, jump.fit, start.joint), row);
  jump.move.shift_m = shift.norm() / std::sqrt(static_cast<double>(n - row));
  // In deviations of the better fit: those of the other hold the jump.
  const double sharper = fit.deviation_m / jump.fit.deviation_m;
  const double over_drift = sharper * sharper * (start.gain - drift_gain(trial, fit, projected));
  const double least = kJumpGain * jump.fit.rows_per_pose;
  if (gained(fit.error_m, jump.fit) < least || gained(fit_arm_to_all(trial, fit).error_m, jump.fit) < least ||
      jump.move.shift_m < std::max(kJumpDeviations * jump.fit.deviation_m, kSmallestShift_m) ||
      jump.move.if_changed_m > kJumpFall * jump.move.as_given_m || over_drift < kGainOverDrift * fit.rows_per_pose)
    return std::nullopt;
  if (std::abs(jump.move.by) > most_by_conditions(trial)) return jump;
  const Eigen::VectorXd behind = from_row(joint_column(trial, fit, start.joint), start.row);
  const double beyond = sharper * sharper * projected.gain_beyond(behind, condition_columns(trial, fit));
  if (beyond < kGainOverDrift * fit.rows_per_pose) return std::nullopt;
  return jump;
}

}  // namespace demecal::inline trials
