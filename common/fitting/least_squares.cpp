#include "fitting/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace demecal {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Keeps the model where Ceres is evaluating it, so that all poses share one robot.
class SharedPoint : public ceres::EvaluationCallback {
 public:
  SharedPoint(const LeastSquares& problem, Eigen::VectorXd start)
      : z(Eigen::VectorXd::Zero(problem.basis.cols())),
        problem_(problem),
        start_(std::move(start)),
        point_(problem.space.at(start_)) {}

  Eigen::VectorXd z;  ///< what Ceres changes

  void PrepareForEvaluation(bool, bool new_point) override {
    if (new_point) point_ = problem_.space.at(change());
  }

  const LeastSquares& problem() const { return problem_; }
  Eigen::VectorXd change() const { return start_ + problem_.basis * z; }

  void evaluate(const Observation& observation, double* residuals, double* jacobian) {
    const LeastSquares& p = problem_;
    if (jacobian == nullptr) {
      scaled_residual(p.data, point_.robot, observation, p.scales, rows_);
    } else {
      scaled_rows(p.data, p.space, point_, observation, p.scales, rows_);
      Eigen::Map<RowMajor>(jacobian, rows_.residual.size(), p.basis.cols()).noalias() = rows_.jacobian * p.basis;
    }
    std::copy_n(rows_.residual.data(), rows_.residual.size(), residuals);
  }

 private:
  const LeastSquares& problem_;
  Eigen::VectorXd start_;
  ModelPoint point_;
  ScaledRows rows_;
};

class PoseCost : public ceres::CostFunction {
 public:
  PoseCost(SharedPoint& shared, const Observation& observation, int rows) : shared_(shared), observation_(observation) {
    set_num_residuals(rows);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shared.z.size()));
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    shared_.evaluate(observation_, residuals, jacobians == nullptr ? nullptr : jacobians[0]);
    return true;
  }

 private:
  SharedPoint& shared_;
  const Observation& observation_;
};

class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const SharedPoint& shared) : shared_(shared) {
    set_num_residuals(shared.problem().space.size());
    mutable_parameter_block_sizes()->push_back(static_cast<int>(shared.z.size()));
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const LeastSquares& problem = shared_.problem();
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = problem.prior.residual(shared_.change());
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[0], num_residuals(), problem.basis.cols()) =
          problem.prior.precision.asDiagonal() * problem.basis;
    }
    return true;
  }

 private:
  const SharedPoint& shared_;
};

/// One loss for each number of rows, shared by all poses that have it.
class Losses {
 public:
  ceres::LossFunction* of(int rows) {
    auto& loss = losses_[rows];
    if (!loss) loss = std::make_unique<ceres::HuberLoss>(huber_threshold(rows));
    return loss.get();
  }

 private:
  std::map<int, std::unique_ptr<ceres::LossFunction>> losses_;
};

void add_poses(ceres::Problem& to, SharedPoint& shared, Losses& losses) {
  const LeastSquares& problem = shared.problem();
  for (const Observation& observation : problem.observations) {
    const int rows = rows_in_use(problem.data.poses[observation.pose], problem.scales);
    if (rows == 0) continue;
    to.AddResidualBlock(new PoseCost(shared, observation, rows), problem.robust ? losses.of(rows) : nullptr,
                        shared.z.data());
  }
}

ceres::Solver::Options solver_options(int max_iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;  // safe: the basis makes the columns near orthonormal
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  return options;
}

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
  if (problem.basis.cols() == 0) return {start, 0.0, true};
  SharedPoint shared(problem, start);
  Losses losses;
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.evaluation_callback = &shared;
  ceres::Problem poses(ownership);
  add_poses(poses, shared, losses);
  if ((problem.prior.precision.array() > 0).any())
    poses.AddResidualBlock(new PriorCost(shared), nullptr, shared.z.data());
  if (poses.NumResidualBlocks() == 0) return {start, 0.0, true};
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(problem.max_iterations), &poses, &summary);
  return {shared.change(), summary.final_cost, summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace demecal
