#include "diagnosis/null_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace demecal {
namespace {

/// Variances of the fitted rows, of what is believed of the model's numbers and of what poses share, each over what it
/// was taken to be, by which what the projection leaves of each of the three is as large as it was found to be on
/// average (quadratic estimation; Rao, 1971). Where hardly anything tells, one.
Eigen::Vector3d variances_found(const Projection& model, double fitted_rows) {
  constexpr double kTakenAsKnown = 2.0;  ///< rows' worth of the assumption
  const Eigen::Index shared = model.shared(), own = model.beliefs_left().size() - shared;
  const auto gram = [](const auto& basis) { return Eigen::MatrixXd(basis.transpose() * basis); };
  const std::array<Eigen::MatrixXd, 3> grams{gram(model.basis()), gram(model.beliefs_basis().topRows(own)),
                                             gram(model.beliefs_basis().bottomRows(shared))};
  const auto believed = [&](Eigen::Index first, Eigen::Index count) {
    const auto begin = model.believed().begin() + first;
    return static_cast<double>(std::count(begin, begin + count, true));
  };
  const std::array rows{fitted_rows, believed(0, own), believed(own, shared)};
  const Eigen::Vector3d found(model.left().squaredNorm(), model.beliefs_left().head(own).squaredNorm(),
                              model.beliefs_left().tail(shared).squaredNorm());
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
    lengths_[count].push_back(model.left().segment(first, count).norm() / std::sqrt(free));
  }
  const Eigen::Vector3d deviations = variances_found(model, fitted_rows).cwiseSqrt();
  const Eigen::Index shared = model.shared();
  belief_deviations_ = Eigen::VectorXd::Constant(model.beliefs_left().size(), deviations[1]);
  belief_deviations_.tail(shared).setConstant(deviations[2]);
  double squares = 0.0;
  for (const auto& [count, lengths] : lengths_)
    for (const double length : lengths) squares += length * length;
  const double larger = deviations[0] * std::sqrt(fitted_rows / std::max(squares, 1e-300));
  for (auto& [count, lengths] : lengths_)
    for (double& length : lengths) length *= larger;
}

NullNoise::Rows NullNoise::draw(RandomStream& random) const {
  Rows drawn{Eigen::VectorXd(field_.rows()), Eigen::VectorXd::Zero(model_.beliefs_left().size())};
  std::map<Eigen::Index, std::vector<double>> dealt = lengths_;
  for (auto& [count, lengths] : dealt)
    for (std::size_t i = lengths.size(); i > 1; --i) std::swap(lengths[i - 1], lengths[random.index(i)]);
  for (std::size_t pose = 0; pose < field_.poses.size(); ++pose) {
    auto rows = drawn.fitted.segment(field_.first_row[pose], field_.rows_of_pose(pose));
    if (field_.root_weight[pose] <= 0.0) {
      rows.setZero();
      continue;
    }
    for (double& value : rows) value = random.normal();
    std::vector<double>& lengths = dealt[rows.size()];
    rows *= lengths.back() / std::max(rows.norm(), 1e-300);
    lengths.pop_back();
  }
  for (Eigen::Index i = 0; i < drawn.beliefs.size(); ++i)
    if (model_.believed()[static_cast<std::size_t>(i)]) drawn.beliefs[i] = belief_deviations_[i] * random.normal();
  return drawn;
}

Eigen::VectorXd NullNoise::left(RandomStream& random) const {
  Rows drawn = draw(random);
  const Eigen::VectorXd along =
      model_.basis().transpose() * drawn.fitted + model_.beliefs_basis().transpose() * drawn.beliefs;
  drawn.fitted -= model_.basis() * along;
  drawn.beliefs -= model_.beliefs_basis() * along;
  const double whole = drawn.fitted.squaredNorm() + drawn.beliefs.squaredNorm();
  return whole > 0 ? Eigen::VectorXd(std::sqrt(model_.squares() / whole) * drawn.fitted) : drawn.fitted;
}

}  // namespace demecal
