#include "fitting/fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "errors/input_error.hpp"
#include "fitting/base_search.hpp"
#include "fitting/identifiable.hpp"
#include "fitting/scatter.hpp"
#include "fitting/triangular_factor.hpp"

namespace demecal {
namespace {

void refuse_unknown_anchors(const DataSet& data, std::span<const std::size_t> poses) {
  if (!data.anchors_unknown) return;
  for (const std::size_t pose : poses) {
    if (data.poses[pose].distances_m.empty()) continue;
    throw InputError({data.file, data.poses[pose].line}, "anchors_mm: unknown",
                     "distances can be fitted only where their anchors are known");
  }
}

/// The first scale of every kind of row that can be fitted.
RowScales first_scales(const DataSet& data, const CorrectedRobot& robot, const std::vector<Observation>& observations,
                       bool tool) {
  constexpr double kMountedOtherwise_rad = 0.1;
  RowScales scales = median_deviations(data, robot, observations);
  if (!tool && root_mean_squares(data, robot, observations)[kOrientation] > kMountedOtherwise_rad) {
    scales[kOrientation] = 0.0;
  }
  return scales;
}

Fit too_few(const CorrectedRobot& start, std::size_t poses, int rows, int parameters) {
  Fit fit;
  fit.robot = start;
  fit.status = FitStatus::too_few_poses;
  fit.sentence = std::to_string(poses) + " poses give " + std::to_string(rows) + " measured numbers; " +
                 std::to_string(parameters) + " free parameters need at least " + std::to_string(parameters + 1);
  return fit;
}

/// The effects of all parameters at the reference.
Effects effects_of(const LeastSquares& problem) {
  TriangularFactor factor(problem.space.size());
  const ModelPoint point = problem.space.at(Eigen::VectorXd::Zero(problem.space.size()));
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_rows(problem.data, problem.space, point, observation, problem.scales, rows);
    factor.add(rows.jacobian);
  }
  return Effects(factor.factor());
}

bool settled(const RowScales& before, const RowScales& after) {
  constexpr double kSettled = 0.01;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (before[kind] > 0 && std::abs(after[kind] / before[kind] - 1) > kSettled) return false;
  }
  return true;
}

struct Result {
  Minimum minimum;
  Scatter scatter;
};

/// Fits and takes the scales from what is left, in turn, until they settle.
Result fit_and_scale(LeastSquares problem) {
  constexpr int kMostRounds = 20;
  Result result;
  result.minimum.change.setZero(problem.space.size());
  for (int round = 0; round < kMostRounds; ++round) {
    result.minimum = minimise(problem, result.minimum.change);
    result.scatter = scatter_at(problem, result.minimum.change);
    const RowScales& scales = problem.robust ? result.scatter.median_deviation : result.scatter.deviation;
    if (settled(problem.scales, scales)) break;
    problem.scales = scales;
  }
  return result;
}

std::vector<ParameterEstimate> estimates_of(const ParameterSpace& space, const ModelPoint& point,
                                            const CorrectedRobot& nominal, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd to_values = value_jacobian(space, point);
  const Eigen::MatrixXd of_values = to_values * covariance * to_values.transpose();
  std::vector<ParameterEstimate> estimates;
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    estimates.push_back({id, parameter_value(nominal, id), parameter_value(point.robot, id),
                         std::sqrt(std::max(0.0, of_values(i, i)))});
  }
  return estimates;
}

std::string summary_of(const Fit& fit, std::size_t poses) {
  std::string text = fit.status == FitStatus::converged ? "" : "the fit did not converge; ";
  text += std::to_string(fit.rank) + " of " + std::to_string(fit.estimates.size()) + " parameters identified from " +
          std::to_string(poses) + " poses";
  if (!fit.outliers.empty()) text += ", " + std::to_string(fit.outliers.size()) + " of them outliers";
  return text;
}

Fit reported(const LeastSquares& problem, const Result& result, const CorrectedRobot& nominal,
             const Eigen::MatrixXd& covariance) {
  const Scatter& scatter = result.scatter;
  const ModelPoint point = problem.space.at(result.minimum.change);
  Fit fit;
  fit.robot = point.robot;
  fit.status = result.minimum.converged ? FitStatus::converged : FitStatus::not_converged;
  fit.sigma_position_m = scatter.deviation[kPosition];
  fit.sigma_orientation_rad = scatter.deviation[kOrientation];
  fit.sigma_distance_m = scatter.deviation[kDistance];
  fit.outliers = scatter.outliers;
  fit.estimates = estimates_of(problem.space, point, nominal, covariance);
  return fit;
}

Fit fit_identifiable(LeastSquares problem, const CorrectedRobot& nominal, double rank_tolerance) {
  const std::vector<ParameterId>& ids = problem.space.ids();
  const Effects effects = effects_of(problem);
  Identifiable seen = identifiable_subspace(effects, ids, rank_tolerance);
  problem.basis = std::move(seen.basis);
  const Result result = fit_and_scale(problem);
  const Eigen::MatrixXd covariance = problem.basis * result.scatter.covariance * problem.basis.transpose();
  Fit fit = reported(problem, result, nominal, covariance);
  fit.unidentified = std::move(seen.held);
  for (auto& weak : weak_directions(effects, ids, covariance, problem.prior.precision)) {
    fit.unidentified.push_back(std::move(weak));
  }
  fit.rank = problem.space.size() - static_cast<int>(fit.unidentified.size());
  fit.sentence = summary_of(fit, problem.observations.size());
  return fit;
}

}  // namespace

Fit fit_declared(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                 const CorrectedRobot& start, const FitOptions& options) {
  refuse_unknown_anchors(data, poses);
  const std::vector<ParameterId> ids = free_parameters(data, declared, options);
  const auto parameters = static_cast<int>(ids.size());
  const auto observations = observe(data, poses, start);
  const int measured = rows_in_use(data, observations, {1.0, 1.0, 1.0});
  if (measured <= parameters) return too_few(start, poses.size(), measured, parameters);
  const CorrectedRobot placed = place(data, poses, declared, start, options);
  const RowScales scales = first_scales(data, placed, observations, declared.tool);
  const int usable = rows_in_use(data, observations, scales);
  if (usable <= parameters) return too_few(start, poses.size(), usable, parameters);
  const ParameterSpace space(placed, ids);
  const CorrectedRobot nominal = nominal_robot(data);
  return fit_identifiable({.data = data,
                           .space = space,
                           .observations = observations,
                           .scales = scales,
                           .basis = {},
                           .prior = link_prior(space, nominal, options),
                           .robust = options.robust,
                           .max_iterations = options.max_iterations},
                          nominal, options.rank_tolerance);
}

Fit fit_registration(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options) {
  return fit_declared(data, poses, {.registration = declared.registration, .tool = declared.tool}, start, options);
}

}  // namespace demecal
