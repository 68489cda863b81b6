#include "fitting/least_squares.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "fitting/row_sums.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "random/distributions.hpp"

namespace demecal::inline fitting {
namespace {

/// The cost at a point and its first two derivatives by z.
struct QuadraticModel {
  double cost = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// Adds the poses' rows. Beyond the threshold Huber's loss is threshold * norm: it pulls with a weight of threshold
/// over norm, and does not curve along the residual. Residuals are taken to be linear in z.
class PoseSum {
 public:
  explicit PoseSum(const LeastSquares& problem)
      : problem_(problem), weighted_(problem.basis), uncurved_(problem.basis) {}

  void add(const ModelPoint& point, const Observation& observation) {
    scaled_rows(problem_.data, problem_.space, point, observation, problem_.scales, rows_);
    const auto used = static_cast<int>(rows_.residual.size());
    if (used == 0) return;
    const double norm = rows_.residual.norm();
    const double threshold = problem_.robust ? huber_threshold(used) : norm;
    if (norm <= threshold) {
      cost_ += 0.5 * norm * norm;
      weighted_.add(rows_.jacobian, rows_.residual, 1.0);
      return;
    }
    cost_ += threshold * (norm - 0.5 * threshold);
    weighted_.add(rows_.jacobian, rows_.residual, threshold / norm);
    const Eigen::RowVectorXd along = (rows_.residual / norm).transpose() * rows_.jacobian;
    uncurved_.add(along, Eigen::VectorXd::Zero(1), threshold / norm);
  }

  QuadraticModel model() { return {cost_, weighted_.gradient(), weighted_.squares() - uncurved_.squares()}; }

 private:
  const LeastSquares& problem_;
  Information weighted_, uncurved_;
  ScaledRows rows_;
  double cost_ = 0.0;
};

QuadraticModel quadratic_model_at(const LeastSquares& problem, const Eigen::VectorXd& change) {
  PoseSum poses(problem);
  const ModelPoint point = problem.space.at(change);
  for (const Observation& observation : problem.observations) poses.add(point, observation);
  QuadraticModel model = poses.model();
  const Eigen::VectorXd prior = problem.prior.residual(change);
  const Eigen::MatrixXd rows = problem.prior.precision.asDiagonal() * problem.basis;
  model.cost += 0.5 * prior.squaredNorm();
  model.gradient.noalias() += rows.transpose() * prior;
  model.curvature.noalias() += rows.transpose() * rows;
  const RelationRows known = relation_rows(problem.data, problem.space, point);
  if (known.residual.size() == 0) return model;
  const Eigen::MatrixXd along = known.jacobian * problem.basis;
  model.cost += 0.5 * known.residual.squaredNorm();
  model.gradient.noalias() += along.transpose() * known.residual;
  model.curvature.noalias() += along.transpose() * along;
  return model;
}

/// A step of z, and by how much it should lower the cost.
struct DampedStep {
  Eigen::VectorXd z;
  double model_cost_change = 0.0;
};

/// Newton's step with the curvature of every direction raised by `damping` times its mean.
DampedStep damped_step(const QuadraticModel& model, double damping) {
  const double raise = damping * std::max(model.curvature.diagonal().mean(), 1e-300);
  const Eigen::Index n = model.gradient.size();
  const Eigen::MatrixXd damped = model.curvature + raise * Eigen::MatrixXd::Identity(n, n);
  const PivotedCholesky factor(damped);
  if (!factor.is_positive()) return {Eigen::VectorXd::Zero(n), -1.0};
  DampedStep step{factor.solve(-model.gradient), 0.0};
  step.model_cost_change = -model.gradient.dot(step.z) - 0.5 * step.z.dot(model.curvature * step.z);
  return step;
}

/// Marquardt's damping: less after every success, more after every failure.
class MarquardtDamping {
 public:
  double value() const { return value_; }
  void relax() {
    value_ = std::max(kLeast, value_ / 10);
    growth_ = 4.0;
  }
  void tighten() {
    value_ *= growth_;
    growth_ *= 2.0;
  }
  bool exhausted() const { return value_ > kMost; }

 private:
  static constexpr double kLeast = 1e-12, kMost = 1e16;
  double value_ = 1e-4, growth_ = 4.0;
};

}  // namespace

double huber_threshold(int rows) {
  static const NormalLengths threshold(0.95);
  return threshold(rows);
}

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start) {
  constexpr double kFunctionTolerance = 1e-12;
  Minimum best{start, 0.0, true};
  if (problem.basis.cols() == 0) return best;
  QuadraticModel model = quadratic_model_at(problem, start);
  MarquardtDamping damping;
  best = {start, model.cost, false};
  for (int i = 0; i < problem.max_iterations && std::isfinite(model.cost) && !damping.exhausted(); ++i) {
    const DampedStep step = damped_step(model, damping.value());
    if (step.model_cost_change >= 0.0 && step.model_cost_change <= kFunctionTolerance * (1.0 + model.cost))
      return {best.change, model.cost, true};
    const Eigen::VectorXd there = best.change + problem.basis * step.z;
    QuadraticModel ahead = step.model_cost_change > 0.0 ? quadratic_model_at(problem, there) : model;
    if (ahead.cost < model.cost) {
      model = std::move(ahead);
      best = {there, model.cost, false};
      damping.relax();
    } else {
      damping.tighten();
    }
  }
  return best;
}

Prior no_prior(int parameters) {
  return {Eigen::VectorXd::Zero(parameters), Eigen::VectorXd::Zero(parameters)};
}

Prior link_prior(const ParameterSpace& space, const CorrectedRobot& nominal, const FitOptions& options) {
  Prior prior = no_prior(space.size());
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    const double deviation = id.is_angle() ? options.prior_rad : options.prior_m;
    if (id.kind != ParameterId::Kind::link || deviation <= 0) continue;
    prior.precision[i] = 1 / deviation;
    prior.offset[i] = parameter_value(space.reference(), id) - parameter_value(nominal, id);
  }
  return prior;
}

namespace {

constexpr double kLeastDeviation = 1e-9;
/// Of a normal distribution: the standard deviation over the median of absolute values.
constexpr double kMedianToDeviation = 1.4826;

/// Inverse of a symmetric matrix in the directions it does not send to nothing.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& symmetric) {
  constexpr double kSingular = 1e-14;
  if (symmetric.size() == 0) return symmetric;
  const auto eigen = eigen_system(symmetric);
  Eigen::VectorXd inverse = eigen.values;
  const double least = kSingular * inverse.maxCoeff();
  for (double& value : inverse) value = value > least ? 1 / value : 0.0;
  return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

double huber_weight(double norm, int rows) {
  const double threshold = huber_threshold(rows);
  return norm > threshold ? threshold / norm : 1.0;
}

/// RowKindSums over the poses of a fit, of one kind of row: J^T J of z, squared residuals over scale, rows; by weight.
struct RowKindSums {
  Eigen::MatrixXd information;
  double squares = 0.0;
  double rows = 0.0;
};

std::array<RowKindSums, kRowKinds> sum_up(const LeastSquares& problem, const Eigen::VectorXd& change) {
  std::array<RowKindSums, kRowKinds> sums;
  std::vector<Information> information(kRowKinds, Information(problem.basis));
  const ModelPoint point = problem.space.at(change);
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_rows(problem.data, problem.space, point, observation, problem.scales, rows);
    const auto used = static_cast<int>(rows.residual.size());
    if (used == 0) continue;
    const double weight = problem.robust ? huber_weight(rows.residual.norm(), used) : 1.0;
    const RowCounts count = count_rows(problem.data.poses[observation.pose]);
    Eigen::Index from = 0;
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      if (problem.scales[kind] <= 0) continue;
      const auto residuals = rows.residual.segment(from, count[kind]);
      information[kind].add(rows.jacobian.middleRows(from, count[kind]), residuals, weight);
      sums[kind].squares += weight * residuals.squaredNorm();
      sums[kind].rows += weight * count[kind];
      from += count[kind];
    }
  }
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) sums[kind].information = information[kind].squares();
  return sums;
}

/// What the prior, and what is known between contacts, tell of z.
Eigen::MatrixXd prior_information(const LeastSquares& problem, const Eigen::VectorXd& change) {
  const Eigen::MatrixXd rows = problem.prior.precision.asDiagonal() * problem.basis;
  const RelationRows known = relation_rows(problem.data, problem.space, problem.space.at(change));
  const Eigen::MatrixXd along = known.jacobian * problem.basis;
  return rows.transpose() * rows + along.transpose() * along;
}

std::vector<std::size_t> find_outliers(const LeastSquares& problem, const CorrectedRobot& robot,
                                       const RowScales& scales) {
  // At least the quantile that one of so many exceeds once in a hundred fits: P(Z > x) < exp(-x^2 / 2) / 2.
  const double normal = std::sqrt(2.0 * std::log(50.0 * static_cast<double>(problem.observations.size())));
  const NormalLengths threshold(1.0 - 0.5 * std::erfc(normal * std::numbers::sqrt2 / 2.0));
  std::vector<std::size_t> outliers;
  ScaledRows rows;
  for (const Observation& observation : problem.observations) {
    scaled_residual(problem.data, robot, observation, scales, rows);
    const auto used = static_cast<int>(rows.residual.size());
    if (used > 0 && rows.residual.norm() > threshold(used)) outliers.push_back(observation.pose);
  }
  std::sort(outliers.begin(), outliers.end());
  return outliers;
}

}  // namespace

RowScales median_deviations(const DataSet& data, const CorrectedRobot& robot,
                            const std::vector<Observation>& observations, const std::vector<StationFactors>& stations) {
  RowScales deviation{};
  deviation.stations = stations;
  std::array<std::vector<double>, kRowKinds> absolute;
  for (const Observation& observation : observations) {
    const Eigen::VectorXd all = unscaled_residual(data, robot, observation);
    const MeasuredPose& pose = data.poses[observation.pose];
    const RowCounts count = count_rows(pose);
    int row = 0;
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      const double factor = deviation.factor(pose, kind);
      for (int i = 0; i < count[kind]; ++i) absolute[kind].push_back(std::abs(all[row++]) / factor);
    }
  }
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (!absolute[kind].empty())
      deviation[kind] = std::max(kLeastDeviation, kMedianToDeviation * median(absolute[kind]));
  }
  return deviation;
}

Scatter scatter_at(const LeastSquares& problem, const Eigen::VectorXd& change) {
  const auto sums = sum_up(problem, change);
  Eigen::MatrixXd information = prior_information(problem, change), rescaled = information;
  for (const RowKindSums& sum : sums) information += sum.information;
  const Eigen::MatrixXd inverse = pseudo_inverse(information);
  const CorrectedRobot robot = problem.space.at(change).robot;
  const RowScales medians = median_deviations(problem.data, robot, problem.observations, problem.scales.stations);
  Scatter scatter;
  scatter.deviation.stations = scatter.median_deviation.stations = problem.scales.stations;
  for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
    if (problem.scales[kind] <= 0) continue;
    const double taken = inverse.cwiseProduct(sums[kind].information).sum();
    const double left = std::max(sums[kind].rows - taken, 1.0);
    scatter.deviation[kind] = std::max(kLeastDeviation, problem.scales[kind] * std::sqrt(sums[kind].squares / left));
    scatter.median_deviation[kind] = medians[kind] * std::sqrt((left + taken) / left);
    rescaled += std::pow(problem.scales[kind] / scatter.deviation[kind], 2) * sums[kind].information;
  }
  scatter.covariance = pseudo_inverse(rescaled);
  scatter.outliers = find_outliers(problem, robot, scatter.median_deviation);
  return scatter;
}

}  // namespace demecal::inline fitting
