#include "fitting/least_squares.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "fitting/information.hpp"

namespace demecal {
namespace {

/// The cost at a point and its first two derivatives by z.
struct Bend {
  double cost = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// Adds the poses' rows. Beyond the threshold Huber's loss is threshold * norm: it pulls with a weight of threshold
/// over norm, and does not curve along the residual. Residuals are taken to be linear in z.
class PoseSum {
 public:
  explicit PoseSum(const LeastSquares& problem) : problem_(problem), pulled_(problem.basis), straight_(problem.basis) {}

  void add(const ModelPoint& point, const Observation& observation) {
    scaled_rows(problem_.data, problem_.space, point, observation, problem_.scales, rows_);
    const auto used = static_cast<int>(rows_.residual.size());
    if (used == 0) return;
    const double norm = rows_.residual.norm();
    const double threshold = problem_.robust ? huber_threshold(used) : norm;
    if (norm <= threshold) {
      cost_ += 0.5 * norm * norm;
      pulled_.add(rows_.jacobian, rows_.residual, 1.0);
      return;
    }
    cost_ += threshold * (norm - 0.5 * threshold);
    pulled_.add(rows_.jacobian, rows_.residual, threshold / norm);
    const Eigen::RowVectorXd along = (rows_.residual / norm).transpose() * rows_.jacobian;
    straight_.add(along, Eigen::VectorXd::Zero(1), threshold / norm);
  }

  Bend bend() { return {cost_, pulled_.gradient(), pulled_.squares() - straight_.squares()}; }

 private:
  const LeastSquares& problem_;
  Information pulled_, straight_;
  ScaledRows rows_;
  double cost_ = 0.0;
};

Bend bend_at(const LeastSquares& problem, const Eigen::VectorXd& change) {
  PoseSum poses(problem);
  const ModelPoint point = problem.space.at(change);
  for (const Observation& observation : problem.observations) poses.add(point, observation);
  Bend bend = poses.bend();
  const Eigen::VectorXd prior = problem.prior.residual(change);
  const Eigen::MatrixXd rows = problem.prior.precision.asDiagonal() * problem.basis;
  bend.cost += 0.5 * prior.squaredNorm();
  bend.gradient.noalias() += rows.transpose() * prior;
  bend.curvature.noalias() += rows.transpose() * rows;
  return bend;
}

/// A step of z, and by how much it should lower the cost.
struct Step {
  Eigen::VectorXd z;
  double promise = 0.0;
};

/// Newton's step with the curvature of every direction raised by `damping` times its mean.
Step damped_step(const Bend& at, double damping) {
  const double raise = damping * std::max(at.curvature.diagonal().mean(), 1e-300);
  const Eigen::Index n = at.gradient.size();
  const Eigen::MatrixXd damped = at.curvature + raise * Eigen::MatrixXd::Identity(n, n);
  const Eigen::LDLT<Eigen::MatrixXd> factor(damped);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return {Eigen::VectorXd::Zero(n), -1.0};
  Step step{factor.solve(-at.gradient), 0.0};
  step.promise = -at.gradient.dot(step.z) - 0.5 * step.z.dot(at.curvature * step.z);
  return step;
}

/// Marquardt's damping: less after every success, more after every failure.
class Damping {
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
  bool hopeless() const { return value_ > kMost; }

 private:
  static constexpr double kLeast = 1e-12, kMost = 1e16;
  double value_ = 1e-4, growth_ = 4.0;
};

}  // namespace

double norm_quantile(int rows, double normal_quantile) {
  const double spread = 2.0 / (9.0 * rows);
  return std::sqrt(rows * std::pow(1.0 - spread + normal_quantile * std::sqrt(spread), 3.0));
}

double huber_threshold(int rows) {
  constexpr double kOnceInTwenty = 1.645;
  return norm_quantile(rows, kOnceInTwenty);
}

Minimum minimise(const LeastSquares& problem, const Eigen::VectorXd& start) {
  constexpr double kSettled = 1e-12;
  Minimum best{start, 0.0, true};
  if (problem.basis.cols() == 0) return best;
  Bend at = bend_at(problem, start);
  Damping damping;
  best = {start, at.cost, false};
  for (int i = 0; i < problem.max_iterations && std::isfinite(at.cost) && !damping.hopeless(); ++i) {
    const Step step = damped_step(at, damping.value());
    if (step.promise >= 0.0 && step.promise <= kSettled * (1.0 + at.cost)) return {best.change, at.cost, true};
    const Eigen::VectorXd there = best.change + problem.basis * step.z;
    Bend ahead = step.promise > 0.0 ? bend_at(problem, there) : at;
    if (ahead.cost < at.cost) {
      at = std::move(ahead);
      best = {there, at.cost, false};
      damping.relax();
    } else {
      damping.tighten();
    }
  }
  return best;
}

}  // namespace demecal
