#include "residuals/null_noise.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "decompositions/decompositions.hpp"

namespace demecal::inline residuals {
namespace {

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

NullResiduals::NullResiduals(const NullNoise& noise, const std::vector<std::size_t>& poses)
    : noise_(noise), poses_(poses) {
  constexpr std::size_t kManyOthers = 500;
  for (const std::size_t pose : poses)
    for (Eigen::Index row = 0; row < noise.field_.rows_of_pose(pose); ++row)
      rows_.push_back(noise.field_.first_row[pose] + row);
  if (noise.field_.poses.size() < poses.size() + kManyOthers) return;
  basis_ = noise.model_.basis()(rows_, Eigen::all);
  others_root_ = PivotedCholesky(square_product(told_by_others())).root();
  for (const auto& [count, lengths] : noise.lengths_)
    for (const double length : lengths) squares_ += length * length;
}

/// The basis at the other poses' rows, times the deviation of a row of a draw.
RowMatrix NullResiduals::told_by_others() const {
  const ResidualField& field = noise_.field_;
  std::map<Eigen::Index, double> deviations;
  for (const auto& [count, lengths] : noise_.lengths_) {
    double squares = 0.0;
    for (const double length : lengths) squares += length * length;
    deviations[count] = std::sqrt(squares / static_cast<double>(lengths.size()) / static_cast<double>(count));
  }
  RowMatrix told = noise_.model_.basis();
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const bool drawn = field.root_weight[pose] <= 0.0 || std::ranges::binary_search(poses_, pose);
    told.middleRows(field.first_row[pose], field.rows_of_pose(pose)) *=
        drawn ? 0.0 : deviations[field.rows_of_pose(pose)];
  }
  return told;
}

Eigen::VectorXd NullResiduals::draw_rows(RandomStream& random) const {
  std::map<Eigen::Index, std::vector<double>> dealt = noise_.lengths_;
  Eigen::VectorXd drawn(static_cast<Eigen::Index>(rows_.size()));
  random.normals({drawn.data(), static_cast<std::size_t>(drawn.size())});
  Eigen::Index first = 0;
  for (const std::size_t pose : poses_) {
    auto rows = drawn.segment(first, noise_.field_.rows_of_pose(pose));
    first += rows.size();
    if (noise_.field_.root_weight[pose] <= 0.0) {
      rows.setZero();
      continue;
    }
    std::vector<double>& lengths = dealt[rows.size()];
    std::swap(lengths[random.index(lengths.size())], lengths.back());
    rows *= lengths.back() / std::max(rows.norm(), 1e-300);
    lengths.pop_back();
  }
  return drawn;
}

Eigen::MatrixXd NullResiduals::draw(Eigen::Index count, RandomStream& random) const {
  if (others_root_.size() == 0) return noise_.residuals(count, rows_, random);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(rows_.size()), count), others(others_root_.cols(), count);
  Eigen::MatrixXd beliefs(noise_.model_.prior_residual().size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    rows.col(i) = draw_rows(random);
    random.normals({others.col(i).data(), static_cast<std::size_t>(others.rows())});
    beliefs.col(i) = noise_.draw_beliefs(random);
  }
  const Eigen::MatrixXd along = transposed_product(basis_, rows) + others_root_ * others +
                                transposed_product(noise_.model_.prior_basis(), beliefs);
  Eigen::MatrixXd left = rows - product(basis_, along);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double whole = squares_ + beliefs.col(i).squaredNorm() - along.col(i).squaredNorm();
    if (whole > 0) left.col(i) *= std::sqrt(noise_.model_.squares() / whole);
  }
  return left;
}

}  // namespace demecal::inline residuals
