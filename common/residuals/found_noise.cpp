#include "residuals/found_noise.hpp"

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

/// The basis at the rows of all poses but those that are drawn, times the deviation of a row of a draw.
RowMatrix told_by_others(RowMatrix told, const NullResiduals& drawn) {
  std::map<Eigen::Index, double> deviations;
  for (const auto& [count, lengths] : drawn.noise.lengths) {
    double squares = 0.0;
    for (const double length : lengths) squares += length * length;
    deviations[count] = std::sqrt(squares / static_cast<double>(lengths.size()) / static_cast<double>(count));
  }
  for (std::size_t pose = 0; pose < drawn.noise.poses(); ++pose) {
    const bool left_out = drawn.noise.silent[pose] || std::ranges::binary_search(drawn.poses, pose);
    const Eigen::Index count = drawn.noise.rows_of_pose(pose);
    told.middleRows(drawn.noise.first_row[pose], count) *= left_out ? 0.0 : deviations[count];
  }
  return told;
}

}  // namespace

NullNoise null_noise(const ResidualField& field, const Projection& model) {
  constexpr double kLeastFree = 0.2;  ///< share of a pose's rows: poses that the model follows tell little of the noise
  NullNoise noise{field.first_row, {}, {}, {}, model.has_prior()};
  double fitted_rows = 0.0;  // gross errors have no weight: none of the residual is theirs
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    noise.silent.push_back(field.root_weight[pose] <= 0.0);
    if (noise.silent.back()) continue;
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    const double followed = model.basis().middleRows(first, count).squaredNorm() / static_cast<double>(count);
    const double free = std::max(kLeastFree, 1.0 - followed);
    fitted_rows += static_cast<double>(count);
    noise.lengths[count].push_back(model.residual().segment(first, count).norm() / std::sqrt(free));
  }
  const Eigen::Vector3d deviations = variances_found(model, fitted_rows).cwiseSqrt();
  noise.belief_deviations = Eigen::VectorXd::Constant(model.prior_residual().size(), deviations[1]);
  noise.belief_deviations.tail(model.shared()).setConstant(deviations[2]);
  const double larger = deviations[0] * std::sqrt(fitted_rows / std::max(noise.squares(), 1e-300));
  for (auto& [count, lengths] : noise.lengths)
    for (double& length : lengths) length *= larger;
  return noise;
}

NullResiduals null_residuals(const ResidualField& field, const Projection& model, std::vector<std::size_t> poses) {
  constexpr std::size_t kManyOthers = 500;
  NullResiduals left{null_noise(field, model), std::move(poses), model.basis(), model.prior_basis(), {},
                     model.squares()};
  if (field.poses.size() < left.poses.size() + kManyOthers) return left;
  left.others_root = PivotedCholesky(square_product(told_by_others(model.basis(), left))).root();
  if (left.others_root.size() > 0) left.basis = model.basis()(left.rows(), Eigen::all);
  return left;
}

}  // namespace demecal::inline residuals
