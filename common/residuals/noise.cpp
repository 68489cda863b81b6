#include "residuals/noise.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>

#include "decompositions/decompositions.hpp"

namespace demecal::inline residuals {
namespace {

constexpr Eigen::Index kPositionAxes = 3;  ///< of positions, the first rows of a pose
constexpr std::size_t kMostRepeated = 200;
constexpr Eigen::Index kMostKnots = 120;
constexpr double kLeastVariance = 0.05;  ///< of a function's part in all rows, over that of independent noise

/// Puts what a unit of an error does to a pose's scaled rows (count x columns) at its place.
void add_whitened_rows(const ResidualField& field, std::size_t pose, Eigen::MatrixXd rows, Eigen::Index column,
                       RowMatrix& to) {
  if (field.within[pose].size() > 0) rows = field.within[pose].triangularView<Eigen::Lower>().solve(rows);
  to.block(field.first_row[pose], column, rows.rows(), rows.cols()) += field.root_weight[pose] * rows;
}

/// The fitted poses of every repeated one, by the first of them.
std::map<std::size_t, std::vector<std::size_t>> repeated_poses(const ResidualField& field) {
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < field.poses.size(); ++i) groups[field.group[i]].push_back(i);
  std::erase_if(groups, [](const auto& group) { return group.second.size() < 2; });
  return groups;
}

/// One set of columns a repeated pose: one a row of it. Judging poses are not repeats of fitted ones.
RowMatrix columns_of_repeats(double size, const ResidualField& field) {
  const auto groups = repeated_poses(field);
  if (groups.size() > kMostRepeated) return RowMatrix(field.rows(), 0);
  Eigen::Index columns = 0;
  for (const auto& [first, poses] : groups) columns += field.rows_of_pose(first);
  RowMatrix result = RowMatrix::Zero(field.rows(), columns);
  Eigen::Index column = 0;
  for (const auto& [first, poses] : groups) {
    const Eigen::Index count = field.rows_of_pose(first);
    for (const std::size_t pose : poses) {
      const Eigen::Index rows = std::min(count, field.rows_of_pose(pose));
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(field.rows_of_pose(pose), rows);
      unit.diagonal().setConstant(size);
      add_whitened_rows(field, pose, unit, column, result);
    }
    column += count;
  }
  return result;
}

/// Functions of the place in the order of measuring whose sum, each with a coefficient of unit variance, has the
/// covariance size^2 correlation^|difference| (exact at the knots, by the nearest Gaussian process between them).
class SharedInOrder {
 public:
  /// `places` ascend.
  SharedInOrder(const NoiseModel& noise, std::span<const std::size_t> places) : noise_(noise) {
    const Eigen::Index knots = std::min(std::ssize(places), kMostKnots);
    places_.resize(knots);
    for (Eigen::Index i = 0; i < knots; ++i)
      places_[i] = static_cast<double>(places[static_cast<std::size_t>(i * std::ssize(places) / knots)]);
    Eigen::MatrixXd covariance(knots, knots);
    for (Eigen::Index i = 0; i < knots; ++i) covariance.col(i) = alike(places_[i]);
    covariance.diagonal().array() += 1e-9;
    const auto eigen = eigen_system(covariance);
    Eigen::Index count = 0;
    while (count < knots && eigen.values[knots - 1 - count] * noise.order * noise.order > kLeastVariance) ++count;
    functions_ =
        noise.order * eigen.vectors.rightCols(count) * eigen.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  }

  Eigen::Index size() const { return functions_.cols(); }
  Eigen::RowVectorXd at(double place) const { return alike(place).transpose() * functions_; }

 private:
  Eigen::VectorXd alike(double place) const {
    Eigen::VectorXd values(places_.size());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values[i] = std::pow(noise_.correlation, std::abs(places_[i] - place));
    return values;
  }

  const NoiseModel& noise_;
  Eigen::VectorXd places_;
  Eigen::MatrixXd functions_;  ///< knots x functions
};

RowMatrix columns_of_drift(const SharedInOrder& drift, const ResidualField& field) {
  RowMatrix result = RowMatrix::Zero(field.rows(), kPositionAxes * drift.size());
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::RowVectorXd values = drift.at(static_cast<double>(field.poses[pose]));
    const Eigen::Index count = field.rows_of_pose(pose);
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(count, result.cols());
    for (Eigen::Index axis = 0; axis < std::min(count, kPositionAxes); ++axis)
      unit.row(axis).segment(axis * drift.size(), drift.size()) = values;
    add_whitened_rows(field, pose, unit, 0, result);
  }
  return result;
}

}  // namespace

double unfollowed_variance(const NoiseModel& noise, std::span<const std::size_t> places) {
  if (noise.order <= 0.0 || places.empty()) return 0.0;
  const SharedInOrder drift(noise, places);
  double followed = 0.0;
  for (const std::size_t place : places) followed += drift.at(static_cast<double>(place)).squaredNorm();
  return std::max(0.0, noise.order * noise.order - followed / static_cast<double>(places.size()));
}

SharedErrors shared_errors(const NoiseModel& noise, const ResidualField& fitted, const ResidualField& validation) {
  SharedErrors shared{RowMatrix(fitted.rows(), 0), RowMatrix(validation.rows(), 0)};
  if (noise.repeats > 0.0) {
    shared.fitted = columns_of_repeats(noise.repeats, fitted);
    shared.validation = RowMatrix::Zero(validation.rows(), shared.fitted.cols());
  }
  if (noise.order > 0.0 && !fitted.poses.empty()) {
    const SharedInOrder drift(noise, fitted.poses);
    shared.fitted = beside(shared.fitted, columns_of_drift(drift, fitted));
    shared.validation = beside(shared.validation, columns_of_drift(drift, validation));
  }
  return shared;
}

}  // namespace demecal::inline residuals
