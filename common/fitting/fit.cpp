#include "fitting/fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "fitting/base_search.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/row_sums.hpp"
#include "fitting/station_scales.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline fitting {
namespace {

void require_known_anchors(const DataSet& data, std::span<const std::size_t> poses) {
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
  RowScales scales = median_deviations(data, robot, observations);
  if (!tool && mounted_otherwise(data, robot, observations)) {
    scales[kOrientation] = 0.0;
  }
  return scales;
}

Fit too_few(const CorrectedRobot& start, std::size_t poses, int rows, int parameters) {
  Fit fit;
  fit.robot = start;
  fit.status = FitStatus::too_few_poses;
  if (poses == 0) {
    fit.sentence = "no pose is a calibration pose, and a model is fitted to these: is the column `set` right?";
    return fit;
  }
  fit.sentence = std::to_string(poses) + (poses == 1 ? " pose gives " : " poses give ") + std::to_string(rows) +
                 " measured numbers; " + std::to_string(parameters) + " free parameters need at least " +
                 std::to_string(parameters + 1) +
                 ": measure more poses, let more of them be calibration poses, or declare fewer parts of the model";
  return fit;
}

/// Takes back out of a pose's rows at the reference that contacts count over the model's size: a direction that only
/// enlarges the arm shows, if by its residuals alone, and is left to prior and known lengths instead of being held.
void leave_size_out(const MeasuredPose& pose, const LeastSquares& problem, ScaledRows& rows) {
  if (pose.contact.empty() || pose.contact_length_m > 0.0 || problem.scales[kPosition] <= 0) return;
  const MeasurementRows count = rows_of(pose);
  rows.jacobian.middleRows(count.position, count.contact) +=
      rows.residual.segment(count.position, count.contact) * problem.space.size_slopes().transpose();
}

/// The effects of all parameters at the reference.
ScaledJacobian jacobian_at_reference(const LeastSquares& problem) {
  TriangularFactor factor(problem.space.size());
  const ModelPoint point = problem.space.at(Eigen::VectorXd::Zero(problem.space.size()));
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_rows(problem.data, problem.space, point, observation, problem.scales, rows);
    leave_size_out(problem.data.poses[observation.pose], problem, rows);
    factor.add(rows.jacobian);
  }
  factor.add(relation_rows(problem.data, problem.space, point).jacobian);
  return ScaledJacobian(factor.factor());
}

struct ScaledFit {
  Minimum minimum;
  Scatter scatter;
};

/// Fits and takes the scales from what is left, in turn, until they settle.
ScaledFit fit_and_scale(LeastSquares problem) {
  constexpr int kMostRounds = 20;
  constexpr double kSettled = 0.01;  ///< of a scale
  ScaledFit result;
  result.minimum.change.setZero(problem.space.size());
  for (int round = 0; round < kMostRounds; ++round) {
    result.minimum = minimise(problem, result.minimum.change);
    result.scatter = scatter_at(problem, result.minimum.change);
    RowScales scales = problem.robust ? result.scatter.median_deviation : result.scatter.deviation;
    if (!problem.data.stations.empty()) {
      const CorrectedRobot robot = problem.space.at(result.minimum.change).robot;
      scales.stations = scales_of_stations(problem.data, robot, problem.observations, scales).stations;
    }
    if (scales_settled(problem.scales, scales, kSettled)) break;
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
    if (id.kind == ParameterId::Kind::contact) continue;
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

/// Standard errors to the robot's effects: all of an effect's coefficients are free, or none.
void set_standard_errors(const std::vector<ParameterEstimate>& estimates, std::vector<Effect>& effects) {
  for (const ParameterEstimate& estimate : estimates) {
    if (estimate.id.kind != ParameterId::Kind::effect) continue;
    Effect& effect = effects[static_cast<std::size_t>(estimate.id.index)];
    effect.standard_errors.resize(effect.values.size());
    effect.standard_errors[static_cast<std::size_t>(estimate.id.coefficient)] = estimate.standard_error;
  }
}

Fit make_fit(const LeastSquares& problem, const ScaledFit& result, const CorrectedRobot& nominal,
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
  set_standard_errors(fit.estimates, fit.robot.effects);
  return fit;
}

Fit fit_identifiable(LeastSquares problem, const CorrectedRobot& nominal, double rank_tolerance) {
  const std::vector<ParameterId>& ids = problem.space.ids();
  const ScaledJacobian jacobian = jacobian_at_reference(problem);
  IdentifiableSubspace seen = identifiable_subspace(jacobian, ids, rank_tolerance);
  problem.basis = std::move(seen.basis);
  const ScaledFit result = fit_and_scale(problem);
  const Eigen::MatrixXd covariance = problem.basis * result.scatter.covariance * problem.basis.transpose();
  Fit fit = make_fit(problem, result, nominal, covariance);
  fit.unidentified = std::move(seen.held);
  for (auto& weak : weak_directions(jacobian, ids, covariance, problem.prior.precision)) {
    fit.unidentified.push_back(std::move(weak));
  }
  leave_out_contacts(fit.unidentified);
  fit.rank = static_cast<int>(fit.estimates.size()) - static_cast<int>(fit.unidentified.size());
  fit.sentence = summary_of(fit, problem.observations.size());
  return fit;
}

/// The declared parameters, where they are to be refitted the coefficients of the start's effects, and the places that
/// the poses touch.
std::vector<ParameterId> parameters_of(const DataSet& data, std::span<const std::size_t> poses,
                                       const DeclaredModel& declared, const CorrectedRobot& start,
                                       const FitOptions& options) {
  std::vector<ParameterId> ids = free_parameters(data, declared);
  if (options.refit_effects)
    for (ParameterId& id : effect_parameters(start)) ids.push_back(std::move(id));
  for (ParameterId& id : contact_parameters(data, poses)) ids.push_back(std::move(id));
  return ids;
}

/// Whether effects that depend on where the tool is seen are told something else at the robot fitted than at its start.
bool motions_differ(const std::vector<Observation>& before, const std::vector<Observation>& after) {
  const auto same = [](const EffectMotion& a, const EffectMotion& b) { return a.unit.size == b.unit.size; };
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto &a = before[i].motions, &b = after[i].motions;
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same)) return true;
  }
  return false;
}

/// Fits from a start whose base and tools stand about where they should.
Fit fit_placed(const DataSet& data, const std::vector<Observation>& observations, const std::vector<ParameterId>& ids,
               const CorrectedRobot& placed, bool tool, const FitOptions& options) {
  const RowScales scales =
      scales_of_stations(data, placed, observations, first_scales(data, placed, observations, tool));
  const auto parameters = static_cast<int>(ids.size());
  const int usable = rows_in_use(data, observations, scales);
  if (usable <= parameters) return too_few(placed, observations.size(), usable, parameters);
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

}  // namespace

Fit fit_declared(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                 const CorrectedRobot& start, const FitOptions& options) {
  require_known_anchors(data, poses);
  const std::vector<ParameterId> ids = parameters_of(data, poses, declared, start, options);
  const auto parameters = static_cast<int>(ids.size());
  int measured = 0;
  for (const std::size_t pose : poses) measured += rows_of(data.poses[pose]).total();
  if (measured <= parameters) return too_few(start, poses.size(), measured, parameters);
  // Far from its tool an arm seems to agree better the larger it is: links are freed where the tool is about right.
  const bool tool_first = declared.tool && declared.geometry && has_contacts(data) && !has_instrument(data);
  const CorrectedRobot near = tool_first ? fit_registration(data, poses, declared, start, options).robot : start;
  const CorrectedRobot placed =
      with_own_contacts(locate_base_and_tools(data, poses, declared, near, options), data, poses);
  const auto observations = observe(data, poses, placed);
  Fit fit = fit_placed(data, observations, ids, placed, declared.tool, options);
  if (fit.status == FitStatus::too_few_poses) {
    fit.robot = start;
    return fit;
  }
  const auto observed_again = observe(data, poses, fit.robot);
  return motions_differ(observations, observed_again)
             ? fit_placed(data, observed_again, ids, fit.robot, declared.tool, options)
             : fit;
}

Fit fit_registration(const DataSet& data, std::span<const std::size_t> poses, const DeclaredModel& declared,
                     const CorrectedRobot& start, const FitOptions& options) {
  FitOptions kept = options;
  kept.refit_effects = false;
  return fit_declared(data, poses, {.registration = declared.registration, .tool = declared.tool}, start, kept);
}

}  // namespace demecal::inline fitting
