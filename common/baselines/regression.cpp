#include "baselines/regression.hpp"

#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"

namespace demecal::inline baselines {
namespace {

/// Keeps what nothing else decides where it is, at no cost to what the rows show.
constexpr double kLeastRidge = 1e-12;

constexpr Eigen::Index kRowsAtOnce = 256;

}  // namespace

std::vector<int> assign_folds(const DataSet& data, std::span<const std::size_t> poses, int folds) {
  std::map<std::string, int> of_id;
  std::vector<int> result;
  int distinct = 0;
  for (const std::size_t pose : poses) {
    const std::string& id = data.poses[pose].pose_id;
    if (id.empty()) {
      result.push_back(distinct++ % folds);
      continue;
    }
    const auto [known, is_new] = of_id.try_emplace(id, distinct % folds);
    if (is_new) ++distinct;
    result.push_back(known->second);
  }
  return result;
}

RidgeSums::RidgeSums(Eigen::Index parameters, Eigen::Index columns)
    : square(Eigen::MatrixXd::Zero(parameters, parameters)), linear(Eigen::MatrixXd::Zero(parameters, columns)) {}

void RidgeSums::add(const Eigen::Ref<const Eigen::MatrixXd>& jacobian,
                    const Eigen::Ref<const Eigen::MatrixXd>& residuals) {
  square.noalias() += jacobian.transpose() * jacobian;
  linear.noalias() += jacobian.transpose() * residuals;
  residual += residuals.squaredNorm();
}

void RidgeSums::add(const RidgeSums& other) {
  square += other.square;
  linear += other.linear;
  residual += other.residual;
}

BufferedRidgeSums::BufferedRidgeSums(Eigen::Index parameters, Eigen::Index columns)
    : sums_(parameters, columns), jacobian_(kRowsAtOnce, parameters), residuals_(kRowsAtOnce, columns) {}

void BufferedRidgeSums::add(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& residuals) {
  if (buffered_ + jacobian.rows() > kRowsAtOnce) sums();
  if (jacobian.rows() > kRowsAtOnce) return sums_.add(jacobian, residuals);
  jacobian_.middleRows(buffered_, jacobian.rows()) = jacobian;
  residuals_.middleRows(buffered_, jacobian.rows()) = residuals;
  buffered_ += jacobian.rows();
}

const RidgeSums& BufferedRidgeSums::sums() {
  if (buffered_ > 0) sums_.add(jacobian_.topRows(buffered_), residuals_.topRows(buffered_));
  buffered_ = 0;
  return sums_;
}

RidgeSums sum_of_parts(const std::vector<RidgeSums>& parts) {
  RidgeSums sum = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) sum.add(parts[i]);
  return sum;
}

RidgeSums RidgeSums::without(const RidgeSums& part) const {
  RidgeSums rest = *this;
  rest.square -= part.square;
  rest.linear -= part.linear;
  rest.residual -= part.residual;
  return rest;
}

double RidgeSums::residual_squares(const Eigen::MatrixXd& change) const {
  return residual - 2.0 * (change.array() * linear.array()).sum() + (change.array() * (square * change).array()).sum();
}

Eigen::MatrixXd ridge_solution(const RidgeSums& sums, const Eigen::VectorXd& weight, double ridge,
                               const Eigen::MatrixXd& offset) {
  const Eigen::Index n = sums.square.rows();
  Eigen::VectorXd size = sums.square.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double least = 1e-12 * size.maxCoeff();
  Eigen::VectorXd unit(n);  // of each parameter: the change that moves the rows by one
  for (Eigen::Index k = 0; k < n; ++k) unit[k] = size[k] > least ? 1.0 / size[k] : 0.0;
  Eigen::MatrixXd square = unit.asDiagonal() * sums.square * unit.asDiagonal();
  Eigen::MatrixXd linear = unit.asDiagonal() * sums.linear;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double held = kLeastRidge + ridge * weight[k];
    square(k, k) += unit[k] > 0.0 ? held : 1.0;
    if (unit[k] > 0.0) linear.row(k) -= held / unit[k] * offset.row(k);
  }
  return unit.asDiagonal() * PivotedCholesky(square).solve(linear);
}

std::span<const double> ridges() {
  static constexpr std::array<double, 11> all{1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0};
  return all;
}

RidgeChoice choose_ridge(const std::vector<RidgeSums>& by_fold, const Eigen::VectorXd& weight) {
  const RidgeSums all = sum_of_parts(by_fold);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(all.linear.rows(), all.linear.cols());
  RidgeChoice best{0.0, std::numeric_limits<double>::infinity()};
  for (const double ridge : ridges()) {
    double cost = 0.0;
    for (const RidgeSums& fold : by_fold) {
      cost += fold.residual_squares(ridge_solution(all.without(fold), weight, ridge, none));
    }
    if (cost < best.cost) best = {ridge, cost};
  }
  return best;
}

}  // namespace demecal::inline baselines
