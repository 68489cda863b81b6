#include "residuals/noise.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

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

/// Variances of the fitted rows, of what is believed of the model's numbers and of what poses share, each over what it
/// was taken to be, by which what the projection leaves of each of the three is as large as it was found to be on
/// average (quadratic estimation; Rao, 1971). Where hardly anything tells, one.
Eigen::Vector3d variances_found(const Projection& model, double fitted_rows) {
  constexpr double kTakenAsKnown = 2.0;  ///< rows' worth of the assumption
  const Eigen::Index shared = model.shared(), own = model.prior_residual().size() - shared;
  const std::array<Eigen::MatrixXd, 3> grams{square_product(model.basis()),
                                             square_product(model.prior_basis().topRows(own)),
                                             square_product(model.prior_basis().bottomRows(shared))};
  const auto believed = [&](Eigen::Index first, Eigen::Index count) {
    const auto begin = model.has_prior().begin() + first;
    return static_cast<double>(std::count(begin, begin + count, true));
  };
  const std::array rows{fitted_rows, believed(0, own), believed(own, shared)};
  const Eigen::Vector3d found(model.residual().squaredNorm(), model.prior_residual().head(own).squaredNorm(),
                              model.prior_residual().tail(shared).squaredNorm());
  Eigen::Matrix3d expected;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (int k = 0; k < 3; ++k) expected(i, k) = grams[at].cwiseProduct(grams[static_cast<std::size_t>(k)]).sum();
    expected(i, i) += rows[at] - 2.0 * grams[at].trace();
  }
  Eigen::Vector3d variances = Eigen::Vector3d::Ones();
  std::array<bool, 3> none{};
  for (int attempt = 0; attempt < 3; ++attempt) {
    Eigen::Matrix3d equations = expected + kTakenAsKnown * Eigen::Matrix3d::Identity();
    Eigen::Vector3d sides = found + kTakenAsKnown * Eigen::Vector3d::Ones();
    for (int i = 0; i < 3; ++i) {
      if (!none[static_cast<std::size_t>(i)]) continue;
      equations.row(i) = Eigen::RowVector3d::Unit(i);
      sides[i] = 0.0;
    }
    variances = equations.fullPivLu().solve(sides);
    if (variances.minCoeff() >= 0.0) break;
    for (int i = 1; i < 3; ++i) none[static_cast<std::size_t>(i)] |= variances[i] < 0.0;
  }
  return variances.cwiseMax(0.0);
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

NullNoise::NullNoise(const ResidualField& field, const Projection& model) : field_(field), model_(model) {
  constexpr double kLeastFree = 0.2;  ///< share of a pose's rows: poses that the model follows tell little of the noise
  double fitted_rows = 0.0;           // gross errors have no weight: none of the residual is theirs
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    if (field.root_weight[pose] <= 0.0) continue;
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    const double followed = model.basis().middleRows(first, count).squaredNorm() / static_cast<double>(count);
    const double free = std::max(kLeastFree, 1.0 - followed);
    fitted_rows += static_cast<double>(count);
    lengths_[count].push_back(model.residual().segment(first, count).norm() / std::sqrt(free));
  }
  const Eigen::Vector3d deviations = variances_found(model, fitted_rows).cwiseSqrt();
  const Eigen::Index shared = model.shared();
  belief_deviations_ = Eigen::VectorXd::Constant(model.prior_residual().size(), deviations[1]);
  belief_deviations_.tail(shared).setConstant(deviations[2]);
  double squares = 0.0;
  for (const auto& [count, lengths] : lengths_)
    for (const double length : lengths) squares += length * length;
  const double larger = deviations[0] * std::sqrt(fitted_rows / std::max(squares, 1e-300));
  for (auto& [count, lengths] : lengths_)
    for (double& length : lengths) length *= larger;
}

Eigen::VectorXd NullNoise::draw_fitted(RandomStream& random) const {
  std::map<Eigen::Index, std::vector<double>> dealt = lengths_;
  for (auto& [count, lengths] : dealt)
    for (std::size_t i = lengths.size(); i > 1; --i) std::swap(lengths[i - 1], lengths[random.index(i)]);
  Eigen::VectorXd drawn(field_.rows());
  random.normals({drawn.data(), static_cast<std::size_t>(drawn.size())});
  for (std::size_t pose = 0; pose < field_.poses.size(); ++pose) {
    auto rows = drawn.segment(field_.first_row[pose], field_.rows_of_pose(pose));
    if (field_.root_weight[pose] <= 0.0) {
      rows.setZero();
      continue;
    }
    std::vector<double>& lengths = dealt[rows.size()];
    rows *= lengths.back() / std::max(rows.norm(), 1e-300);
    lengths.pop_back();
  }
  return drawn;
}

Eigen::VectorXd NullNoise::draw_beliefs(RandomStream& random) const {
  Eigen::VectorXd drawn = Eigen::VectorXd::Zero(model_.prior_residual().size());
  for (Eigen::Index i = 0; i < drawn.size(); ++i)
    if (model_.has_prior()[static_cast<std::size_t>(i)]) drawn[i] = belief_deviations_[i] * random.normal();
  return drawn;
}

NullNoise::Draws NullNoise::draw(Eigen::Index count, RandomStream& random) const {
  constexpr Eigen::Index kRowsAtATime = 512;  // that lie near the processor together
  Eigen::MatrixXd fitted(field_.rows(), count), beliefs(model_.prior_residual().size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    fitted.col(i) = draw_fitted(random);
    beliefs.col(i) = draw_beliefs(random);
  }
  Draws draws{RowMatrix(fitted.rows(), count), beliefs};
  for (Eigen::Index first = 0; first < fitted.rows(); first += kRowsAtATime) {
    const Eigen::Index rows = std::min(kRowsAtATime, fitted.rows() - first);
    draws.fitted.middleRows(first, rows) = fitted.middleRows(first, rows);
  }
  return draws;
}

Eigen::MatrixXd NullNoise::residuals(Eigen::Index count, const std::vector<Eigen::Index>& rows,
                                     RandomStream& random) const {
  const auto [fitted, beliefs] = draw(count, random);
  const Eigen::MatrixXd along =
      transposed_product(model_.basis(), fitted) + transposed_product(model_.prior_basis(), beliefs);
  Eigen::MatrixXd left = fitted(rows, Eigen::all) - product(model_.basis()(rows, Eigen::all), along);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double whole = fitted.col(i).squaredNorm() + beliefs.col(i).squaredNorm() - along.col(i).squaredNorm();
    if (whole > 0) left.col(i) *= std::sqrt(model_.squares() / whole);
  }
  return left;
}

}  // namespace demecal::inline residuals
