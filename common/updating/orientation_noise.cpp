#include "updating/orientation_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "decompositions/decompositions.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kLeastNoise_rad = 1e-7;

/// Enough poses to know a noise by.
std::vector<std::size_t> some_with_orientation(const DataSet& data, const std::vector<std::size_t>& poses) {
  constexpr std::size_t kMost = 60;
  std::vector<std::size_t> measured, some;
  for (const std::size_t pose : poses)
    if (data.poses[pose].orientation) measured.push_back(pose);
  const std::size_t step = 1 + measured.size() / (kMost + 1);
  for (std::size_t i = 0; i < measured.size(); i += step) some.push_back(measured[i]);
  return some;
}

Eigen::MatrixXd all_columns(const ScaledChangeRows& rows) {
  Eigen::MatrixXd all(rows.values.size(), 0);
  for (const Eigen::MatrixXd& columns : rows.columns) {
    all.conservativeResize(Eigen::NoChange, all.cols() + columns.cols());
    all.rightCols(columns.cols()) = columns;
  }
  return all;
}

}  // namespace

DataSet without_unknown_orientations(const CalibratedModel& model, DataSet data) {
  std::set<std::string> known;
  if (model.posterior)
    for (const ParameterId& id : model.posterior->ids)
      if (id.kind == ParameterId::Kind::tool_rotation) known.insert(id.target);
  for (MeasuredPose& pose : data.poses)
    if (!known.contains(pose.target)) pose.orientation.reset();
  return data;
}

OrientationNoise orientation_noise(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                   const std::vector<Effect>& effects) {
  constexpr int kRounds = 8;
  const std::vector<std::size_t> poses = some_with_orientation(data, compared.poses);
  if (poses.empty()) return {};
  ComparedPoses some{compared.robot, poses, compared.noise_m, 1.0, compared.set_up_anew, compared.rounding};
  const ScaledChangeRows rows = scaled_change_rows(model, data, some, effects);
  const Eigen::MatrixXd columns = all_columns(rows);
  const Eigen::Index n = rows.values.size();
  OrientationNoise noise{
      std::max(kLeastNoise_rad, rows.values(rows.turned).norm() / std::sqrt(static_cast<double>(rows.turned.size()))),
      0.0};
  for (int round = 0; round < kRounds; ++round) {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
    scale(rows.turned).setConstant(1.0 / noise.noise_rad);
    const Eigen::MatrixXd covariance = scale.asDiagonal() * rows.covariance * scale.asDiagonal();
    const Cholesky root(Eigen::MatrixXd::Identity(n, n) + covariance);
    const Eigen::MatrixXd explained = PivotedQr(root.whitened(Eigen::MatrixXd(scale.asDiagonal() * columns))).basis();
    Eigen::MatrixXd left = root.whitened(Eigen::MatrixXd::Identity(n, n));
    left -= explained * (explained.transpose() * left).eval();
    const Eigen::VectorXd errors = left.transpose() * (left * (scale.asDiagonal() * rows.values)).eval();
    noise.freedom = left(Eigen::all, rows.turned).squaredNorm();
    if (!(noise.freedom > 0.0)) return {};
    noise.noise_rad =
        std::max(kLeastNoise_rad, noise.noise_rad * std::sqrt(errors(rows.turned).squaredNorm() / noise.freedom));
  }
  return noise;
}

}  // namespace demecal::inline updating
