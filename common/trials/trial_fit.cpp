#include "trials/trial_fit.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "parameters/declared_model.hpp"
#include "random/distributions.hpp"
#include "trials/placed_rows.hpp"

namespace demecal::inline trials {
namespace {

constexpr double kSmallestScale_m = 1e-6;
constexpr double kUsualShare = 2e-4;      ///< of the reach, which fitted links leave: 0.1 to 0.4 mm of medium arms
constexpr double kTukey = 6.0;            ///< deviations at which a row's weight is nothing
constexpr double kToolDeviation_m = 1.0;  ///< tools may be anywhere on the flange
constexpr int kRegistrations = 8, kPlacingSteps = 6, kSearchSteps = 20, kArmSteps = 8;

double tukey_weight(double error_m, double deviation_m) {
  const double share = error_m / (kTukey * deviation_m);
  return share >= 1.0 ? 0.0 : (1 - share * share) * (1 - share * share);
}

/// What errors of unit deviation reach at a share of their rows, kept from one step to the next: the rank is mostly the
/// same, and the quantile takes longer than all that it is divided into.
class UnitErrors {
 public:
  double at(double share) {
    if (share != share_) length_ = normal_length_quantile(3, share_ = share);
    return length_;
  }

 private:
  double share_ = -1.0, length_ = 0.0;
};

/// The scale as fit_base_and_tools states it.
double deviation_of(std::vector<double> errors, double fitted_rows, double usual_m, UnitErrors& unit) {
  const auto n = static_cast<double>(errors.size());
  const double fitted = std::min(fitted_rows, n), rank = std::clamp(std::ceil(0.5 * (n + fitted)), 1.0, n);
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(rank - 1.0);
  std::nth_element(errors.begin(), at, errors.end());
  const double raw_m = *at / unit.at((rank - 0.5) / n);
  const double deviation_m = std::sqrt((usual_m * usual_m + n * raw_m * raw_m) / (1.0 + n - fitted));
  return std::max(deviation_m, kSmallestScale_m);
}

/// Registers the rows of one station, rows far out counting less and less.
void register_station(const Trial& trial, const PlacedRows& placed, int station, TrialFit& fit) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < trial.rows.size(); ++i)
    if (trial.rows[i].station == station) rows.push_back(i);
  if (rows.empty()) return;
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t at = rows[static_cast<std::size_t>(i)];
    const TrialRow& row = trial.rows[at];
    from.col(i) = placed.flange(at) * trial.tools_m[static_cast<std::size_t>(row.target)];
    to.col(i) = row.point_m;
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
  Eigen::Isometry3d& base = fit.sensor_from_base[static_cast<std::size_t>(station)];
  for (int repetition = 0; repetition < kRegistrations; ++repetition) {
    base = weighted_registration(from, to, weights);
    const Eigen::VectorXd errors = ((base.linear() * from).colwise() + base.translation() - to).colwise().norm();
    weights = errors.cwiseMax(1e-4).cwiseInverse();
  }
}

void measure_errors(const Trial& trial, const PlacedRows& placed, UnitErrors& unit, TrialFit& fit) {
  fit.error_m.resize(trial.rows.size());
  for (std::size_t i = 0; i < trial.rows.size(); ++i) {
    fit.error_m[i] = (trial.rows[i].point_m - placed.point(fit, i, trial.rows[i])).norm();
    if (!std::isfinite(fit.error_m[i])) fit.error_m[i] = std::numeric_limits<double>::max();
  }
  if (fit.error_m.empty()) {
    fit.median_m = fit.deviation_m = std::numeric_limits<double>::infinity();
    return;
  }
  fit.median_m = median(fit.error_m);
  fit.deviation_m = deviation_of(fit.error_m, fit.rows_per_pose * fit.effective_parameters / 3.0, fit.usual_m, unit);
}

double link_deviation(LinkParameter parameter) {
  return parameter == LinkParameter::d || parameter == LinkParameter::a ? kMakersDeviation_m : kMakersDeviation_rad;
}

struct WeightedEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};

void add_priors(const Trial& trial, const TrialFit& fit, const ParameterPlaces& places, WeightedEquations& normal) {
  const auto pull = [&normal](int at, double deviation, double off) {
    normal.information(at, at) += 1.0 / (deviation * deviation);
    normal.gradient[at] -= off / (deviation * deviation);
  };
  for (int i = 0; i < 6 * places.stations; ++i) pull(i, 1e3, 0.0);
  for (int target = 0; target < places.tools; ++target) {
    const auto at = static_cast<std::size_t>(target);
    for (int axis = 0; axis < 3; ++axis)
      pull(places.tool(target) + axis, kToolDeviation_m, fit.tools_m[at][axis] - trial.tools_m[at][axis]);
  }
  for (int joint = 0; places.links && joint < places.joints; ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    for (int i = 0; i < kLinkParameters; ++i) {
      const auto parameter = static_cast<LinkParameter>(i);
      pull(places.link(joint) + i, link_deviation(parameter),
           fit.chain.joints[at].parameter(parameter) - trial.chain.joints[at].parameter(parameter));
    }
  }
}

void move(TrialFit& fit, const ParameterPlaces& places, const Eigen::VectorXd& step) {
  for (int station = 0; station < places.stations; ++station) {
    Eigen::Isometry3d& base = fit.sensor_from_base[static_cast<std::size_t>(station)];
    base.translation() += step.segment<3>(6 * station);
    base.linear() = rotation_of(step.segment<3>(6 * station + 3)) * base.linear();
  }
  for (int target = 0; target < places.tools; ++target)
    fit.tools_m[static_cast<std::size_t>(target)] += step.segment<3>(places.tool(target));
  for (int joint = 0; places.links && joint < places.joints; ++joint)
    for (int i = 0; i < kLinkParameters; ++i)
      fit.chain.joints[static_cast<std::size_t>(joint)].parameter(static_cast<LinkParameter>(i)) +=
          step[places.link(joint) + i];
}

/// Takes a Gauss-Newton step, with Tukey's weights if it is to be robust; false where none can be taken. The rows are
/// placed at the fit's links, before and after.
bool step_down(const Trial& trial, const ParameterPlaces& places, bool robust, PlacedRows& placed, UnitErrors& unit,
               TrialFit& fit) {
  const auto n = static_cast<Eigen::Index>(trial.rows.size());
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * n, places.size());
  Eigen::VectorXd error = Eigen::VectorXd::Zero(3 * n);
  LinearRow linear;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double share = robust ? tukey_weight(fit.error_m[at], fit.deviation_m) : 1.0;
    if (share <= 0.0) continue;
    const double root_weight = std::sqrt(share) / fit.deviation_m;
    placed.linearize(fit, at, trial.rows[at], places, linear);
    jacobian.middleRows<3>(3 * i) = root_weight * linear.jacobian;
    error.segment<3>(3 * i) = root_weight * linear.error_m;
  }
  WeightedEquations normal{jacobian.transpose() * jacobian, jacobian.transpose() * error};
  const Eigen::MatrixXd by_points = normal.information;
  add_priors(trial, fit, places, normal);
  const PivotedCholesky factor(normal.information);
  const Eigen::VectorXd step = factor.solve(normal.gradient);
  if (!step.allFinite()) return false;
  fit.covariance = factor.solve(Eigen::MatrixXd::Identity(places.size(), places.size()));
  fit.effective_parameters = std::clamp(fit.covariance.cwiseProduct(by_points).sum(), 0.0, double(places.size()));
  move(fit, places, step);
  if (places.links) placed.place(fit.chain, trial.rows);
  measure_errors(trial, placed, unit, fit);
  return true;
}

ParameterPlaces places_in_equations(const Trial& trial, bool links) {
  return {trial.stations, static_cast<int>(trial.tools_m.size()), trial.chain.size(), links};
}

/// Steps as long as they lower the median, twice over at most where they do not.
TrialFit descend(const Trial& trial, const ParameterPlaces& places, PlacedRows placed, UnitErrors unit, TrialFit fit,
                 int steps) {
  TrialFit best = fit;
  int worse = 0;
  for (int i = 0; i < steps && worse < 2; ++i) {
    const double before = fit.median_m;
    if (!step_down(trial, places, true, placed, unit, fit)) break;
    worse = fit.median_m < 0.999 * before ? 0 : worse + 1;
    if (fit.median_m <= best.median_m) best = fit;
  }
  return best;
}

}  // namespace

Eigen::Vector3d predicted_point(const TrialFit& fit, const TrialRow& row) {
  return fit.sensor_from_base[static_cast<std::size_t>(row.station)] *
         (forward(FixedTurns(fit.chain), row.joints) * fit.tools_m[static_cast<std::size_t>(row.target)]);
}

TrialFit fit_base_and_tools(const Trial& trial) {
  return fit_base_and_tools(trial, PlacedRows(trial.chain, trial.rows, false));
}

TrialFit fit_base_and_tools(const Trial& trial, const PlacedRows& placed) {
  TrialFit fit;
  fit.chain = trial.chain;
  fit.tools_m = trial.tools_m;
  fit.sensor_from_base.assign(static_cast<std::size_t>(trial.stations), Eigen::Isometry3d::Identity());
  for (int station = 0; station < trial.stations; ++station) register_station(trial, placed, station, fit);
  fit.rows_per_pose = trial.rows_per_pose();
  fit.usual_m = kUsualShare * placed.reach_m(trial);
  UnitErrors unit;
  measure_errors(trial, placed, unit, fit);
  return descend(trial, places_in_equations(trial, false), placed, unit, std::move(fit), kPlacingSteps);
}

TrialFit refit_base_and_tools(const Trial& trial, TrialFit start) {
  const PlacedRows placed(start.chain, trial.rows, false);
  return refit_base_and_tools(trial, std::move(start), placed);
}

TrialFit refit_base_and_tools(const Trial& trial, TrialFit start, const PlacedRows& placed) {
  UnitErrors unit;
  measure_errors(trial, placed, unit, start);
  return descend(trial, places_in_equations(trial, false), placed, unit, std::move(start), kSearchSteps);
}

TrialFit fit_arm(const Trial& trial, const TrialFit& placed) {
  return descend(trial, places_in_equations(trial, true), PlacedRows(placed.chain, trial.rows, true), {}, placed,
                 kArmSteps);
}

TrialFit fit_arm_to_all(const Trial& trial, const TrialFit& placed) {
  PlacedRows rows(placed.chain, trial.rows, true);
  UnitErrors unit;
  TrialFit fit = placed;
  for (int i = 0; i < kArmSteps && step_down(trial, places_in_equations(trial, true), false, rows, unit, fit); ++i)
    continue;
  return fit;
}

LinearizedTrial linearized(const Trial& trial, const TrialFit& fit) {
  const ParameterPlaces places = places_in_equations(trial, true);
  WeightedEquations priors{Eigen::MatrixXd::Zero(places.size(), places.size()), Eigen::VectorXd::Zero(places.size())};
  add_priors(trial, fit, places, priors);
  const PlacedRows placed(fit.chain, trial.rows, true);
  const auto n = static_cast<Eigen::Index>(trial.rows.size());
  LinearizedTrial linear{Eigen::MatrixXd(3 * n, places.size()), priors.information.diagonal(), Eigen::VectorXd(3 * n)};
  LinearRow of_row;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    placed.linearize(fit, at, trial.rows[at], places, of_row);
    linear.jacobian.middleRows<3>(3 * i) = of_row.jacobian;
    linear.error_m.segment<3>(3 * i) = of_row.error_m;
  }
  return linear;
}

Eigen::Isometry3d weighted_registration(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                                        const Eigen::VectorXd& weights) {
  const double sum = weights.sum();
  const Eigen::Vector3d from_mean = from * weights / sum, to_mean = to * weights / sum;
  const Eigen::Matrix3d cross =
      (to.colwise() - to_mean) * weights.asDiagonal() * (from.colwise() - from_mean).transpose();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = nearest_rotation(cross);
  motion.translation() = to_mean - motion.linear() * from_mean;
  return motion;
}

}  // namespace demecal::inline trials
